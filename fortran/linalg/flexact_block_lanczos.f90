! SPDX-License-Identifier: BSD-3-Clause
!> The eigenvalues of largest magnitude of an operator that is self-adjoint in an inner
!> product, by the block Lanczos process with full orthogonalisation and thick restarts
!> (Wu and Simon, SIAM J. Matrix Anal. Appl. 22, 2000, pp. 602-616).
!>
!> The inner product may be positive semidefinite, such as that of a mass matrix with
!> directions without mass: vectors are made by the operator alone, whose range has none of
!> them. Where the process ends before all is found, as it does with more equal eigenvalues
!> than a block has vectors, it goes on with new random vectors, until these bring nothing.
module flexact_block_lanczos
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_error, only: error_t, fail, error_memory, error_not_found
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm, dgemv
   use flexact_orthonormal, only: fill_at_random
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: self_adjoint_t, largest_pairs, end_pairs

   type, abstract :: self_adjoint_t
   contains
      !> y = Op x for x, y (n, k), W x being at hand.
      procedure(image_of), deferred :: apply
      !> y = W x: products x'W y are the inner product, in which Op is self-adjoint.
      procedure(product_of), deferred :: weigh
   end type self_adjoint_t

   abstract interface
      subroutine image_of(self, x, weighed, y)
         import :: self_adjoint_t, wp
         class(self_adjoint_t), intent(in) :: self
         real(wp), intent(in), contiguous :: x(:, :), weighed(:, :)
         real(wp), intent(out), contiguous :: y(:, :)
      end subroutine image_of

      subroutine product_of(self, x, y)
         import :: self_adjoint_t, wp
         class(self_adjoint_t), intent(in) :: self
         real(wp), intent(in), contiguous :: x(:, :)
         real(wp), intent(out), contiguous :: y(:, :)
      end subroutine product_of
   end interface

   !> Op V = V H + next times coupling, for the first `used` vectors V.
   type :: process_t
      integer :: used = 0, fresh = 0, seed = 0
      real(wp) :: accuracy = 0.0_wp
      real(wp), allocatable :: space(:, :), weighed(:, :), h(:, :), coupling(:, :)
      !> Of which the first `fresh` vectors are there.
      real(wp), allocatable :: next(:, :), next_weighed(:, :)
   end type process_t

   !> Vectors of a block: as many as eigenvalues may be equal without a second start.
   integer, parameter :: usual_width = 8
   !> Blocks that are kept before a restart, beyond four times the vectors wanted.
   integer, parameter :: reserve = 10
   integer, parameter :: most_restarts = 100
   !> Vectors for each wanted before it is asked whether these have converged.
   integer, parameter :: first_look = 4
   !> Part of a vector's length below which what is left of it is rounding.
   real(wp), parameter :: nothing = 1.0e-12_wp
   !> Vectors after which both ends are given up, and before it is asked whether they are there.
   integer, parameter :: most_vectors = 120, first_vectors = 8
   !> How much of a start is at random.
   real(wp), parameter :: unexpected = 0.05_wp
   !> Part of a value at an end by which it may err, and by which others are next to it.
   real(wp), parameter :: sure = 1.0e-11_wp, next_to = 1.0e-6_wp
   !> Residual of a converged pair to its eigenvalue, which errs by its square, and to the largest one.
   real(wp), parameter :: converged = 1.0e-8_wp, noise = 1.0e-14_wp
   !> Eigenvalues below this part of the largest are zero.
   real(wp), parameter :: zero = 1.0e-13_wp

contains

   !> Up to `wanted` eigenvalues of largest magnitude, which descends, with vectors (n, :) of
   !> norm 1 in the inner product: fewer where the operator has no more that are not zero.
   !> Block: how many vectors are sent through the operator at a time, usually 8. Accuracy: of
   !> the residuals, relative to the value, usually 1e-10; values have the square of it.
   subroutine largest_pairs(operator, n, wanted, values, vectors, error, block, accuracy)
      class(self_adjoint_t), intent(in) :: operator
      integer, intent(in) :: n, wanted
      real(wp), allocatable, intent(out) :: values(:), vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      integer, intent(in), optional :: block
      real(wp), intent(in), optional :: accuracy
      type(process_t) :: process
      real(wp), allocatable :: theta(:), turn(:, :)
      integer :: restarts, found, width

      width = min(n, usual_width)
      if (present(block)) width = min(n, block)
      process%accuracy = converged
      if (present(accuracy)) process%accuracy = accuracy
      allocate (values(0), vectors(n, 0))
      if (n == 0 .or. wanted < 1) return
      call begin(operator, n, width, min(n, 4*wanted + reserve*width), process, error)
      if (allocated(error)) return
      do restarts = 0, most_restarts
         theta = [real(wp) ::]
         do
            call go_on(operator, process)
            if (process%fresh == 0 .or. process%used + process%fresh > size(process%space, 2)) exit
            if (modulo(process%used, 2*width) /= 0 .or. process%used < first_look*wanted) cycle
            call ritz_pairs(process, theta, turn, error)
            if (allocated(error)) return
            if (are_converged(process, theta, turn, wanted)) exit
         end do
         if (size(theta) < process%used) call ritz_pairs(process, theta, turn, error)
         if (allocated(error)) return
         if (process%fresh == 0 .or. are_converged(process, theta, turn, wanted)) exit
         call restart(process, theta, turn, wanted)
      end do
      if (restarts > most_restarts) call fail(error_not_found, error)
      found = min(wanted, count(abs(theta) > zero*maxval(abs(theta))))
      if (found == 0) return
      values = theta(:found)
      vectors = product_with(process%space(:, :process%used), turn(:, :found))
   end subroutine largest_pairs

   !> The two least and the two largest eigenvalues, ascending, of an operator that is symmetric
   !> itself, W being 1, with vectors (n, 4) of norm 1: fewer of a small one. is_there: whether the
   !> least and the largest have converged, but for others next to them; one whose magnitude is
   !> below a part of the other's, `none`, need not. start (n): about what vectors are expected to
   !> be, summed up; without it all are alike.
   subroutine end_pairs(operator, n, none, values, vectors, is_there, error, start)
      class(self_adjoint_t), intent(in) :: operator
      integer, intent(in) :: n
      real(wp), intent(in) :: none
      real(wp), allocatable, intent(out) :: values(:), vectors(:, :)
      logical, intent(out) :: is_there
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: start(:)
      real(wp) :: space(n, min(n, most_vectors)), h(size(space, 2), size(space, 2)), image(n, 1), part(size(space, 2))
      real(wp) :: left, end(2), wrong(2), gap
      real(wp), allocatable :: theta(:), turn(:, :)
      integer, allocatable :: chosen(:)
      integer :: used, look, round, i

      allocate (values(0), vectors(n, 0))
      is_there = n == 0
      if (n == 0) return
      call fill_at_random(1, image)
      if (present(start)) image(:, 1) = unexpected*image(:, 1)/norm2(image) + start/norm2(start)
      space(:, 1) = image(:, 1)/norm2(image)
      h = 0.0_wp
      look = min(first_vectors, size(space, 2))
      do used = 1, size(space, 2)
         call operator%apply(space(:, used:used), space(:, used:used), image)
         do round = 1, 2
            call dgemv('T', n, used, 1.0_wp, space, n, image, 1, 0.0_wp, part, 1)
            call dgemv('N', n, used, -1.0_wp, space, n, part, 1, 1.0_wp, image, 1)
            h(used, used) = h(used, used) + part(used)
         end do
         left = norm2(image)
         if (.not. left > nothing*maxval(abs(h(:used, :used)))) left = 0.0_wp
         if (used == look .or. .not. left > 0) then
            turn = h(:used, :used)
            theta = spread(0.0_wp, 1, used)
            call symmetric_eigenpairs(turn, theta, error)
            if (allocated(error)) return
            end = theta([1, used])
            wrong = left*abs(turn(used, [1, used]))
            ! A value errs by no more than its residual, and than its square over the gap to others.
            do i = 1, 2
               gap = minval(abs(theta - end(i)), abs(theta - end(i)) > next_to*abs(end(i)))
               wrong(i) = min(wrong(i), wrong(i)**2/gap)
            end do
            is_there = all(wrong <= sure*abs(end) .or. abs(end) + wrong <= none*maxval(abs(end)))
            if (is_there .or. used == size(space, 2)) exit
            look = min(used + max(4, used/4), size(space, 2))
         end if
         space(:, used + 1) = image(:, 1)/left
         h(used + 1, used) = left
         h(used, used + 1) = left
      end do
      used = size(theta)
      chosen = pack([(i, i=1, used)], [(min(i - 1, used - i) < 2, i=1, used)])
      values = theta(chosen)
      vectors = product_with(space(:, :used), turn(:, chosen))
   end subroutine end_pairs

   subroutine begin(operator, n, width, most, process, error)
      class(self_adjoint_t), intent(in) :: operator
      integer, intent(in) :: n, width, most
      type(process_t), intent(inout) :: process
      type(error_t), allocatable, intent(out) :: error
      integer :: info

      allocate (process%space(n, most), process%weighed(n, most), process%next(n, width), &
                process%next_weighed(n, width), stat=info)
      if (info == 0) allocate (process%h(most, most), process%coupling(width, most), source=0.0_wp, stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call begin_anew(operator, process)
   end subroutine begin

   !> The next block from random vectors, sent twice through the operator.
   subroutine begin_anew(operator, process)
      class(self_adjoint_t), intent(in) :: operator
      type(process_t), intent(inout) :: process
      real(wp) :: unused(size(process%space, 2), size(process%next, 2)), rest(size(process%next, 2), size(process%next, 2))
      real(wp) :: image(size(process%next, 1), size(process%next, 2))
      integer :: round

      process%seed = process%seed + 1
      process%fresh = size(process%next, 2)
      call fill_at_random(process%seed, process%next)
      do round = 1, 2
         call operator%weigh(process%next, process%next_weighed)
         image = process%next
         call operator%apply(image, process%next_weighed, process%next)
      end do
      call make_orthonormal(operator, process, unused, rest)
   end subroutine begin_anew

   !> Join the next block to the space, and make another from its image.
   subroutine go_on(operator, process)
      class(self_adjoint_t), intent(in) :: operator
      type(process_t), intent(inout) :: process
      real(wp) :: products(size(process%space, 2), size(process%next, 2)), rest(size(process%next, 2), size(process%next, 2))
      integer :: first, last, block

      block = process%fresh
      first = process%used + 1
      last = process%used + block
      if (block == 0) return
      process%space(:, first:last) = process%next(:, :block)
      process%weighed(:, first:last) = process%next_weighed(:, :block)
      process%used = last
      call operator%apply(process%space(:, first:last), process%weighed(:, first:last), process%next(:, :block))
      call make_orthonormal(operator, process, products, rest)
      process%h(:last, first:last) = products(:last, :block)
      process%h(first:last, :last) = transpose(products(:last, :block))
      process%coupling(:, :last) = 0.0_wp
      process%coupling(:, first:last) = rest(:, :block)
      if (process%fresh == 0) call begin_anew(operator, process)
   end subroutine go_on

   !> Make the images in `next` orthogonal to the space (twice) and to each other:
   !> images = space products + next rest. Those of which nothing is left are dropped.
   subroutine make_orthonormal(operator, process, products, rest)
      class(self_adjoint_t), intent(in) :: operator
      type(process_t), intent(inout) :: process
      real(wp), intent(out) :: products(:, :), rest(:, :)
      real(wp) :: first(size(rest, 1), size(rest, 1)), second(size(rest, 1), size(rest, 1))
      real(wp) :: length(size(rest, 1)), again(size(products, 1), size(products, 2))
      integer :: images, kept

      images = process%fresh
      call take_out(operator, process, products)
      length(:images) = norm2(products(:process%used, :images), 1)
      call orthonormalise_block(process, 2, nothing, length(:images), first)
      kept = process%fresh
      call take_out(operator, process, again)
      length(:kept) = 1.0_wp
      call orthonormalise_block(process, 1, 0.1_wp, length(:kept), second)
      products(:process%used, :images) = products(:process%used, :images) &
                                         + matmul(again(:process%used, :kept), first(:kept, :images))
      rest = 0.0_wp
      rest(:, :images) = matmul(second(:, :kept), first(:kept, :images))
   end subroutine make_orthonormal

   !> Take out of `next` what is in the space.
   subroutine take_out(operator, process, products)
      class(self_adjoint_t), intent(in) :: operator
      type(process_t), intent(inout) :: process
      real(wp), intent(inout) :: products(:, :)
      integer :: n

      n = size(process%space, 1)
      associate (used => process%used, fresh => process%fresh)
         if (fresh == 0) return
         if (used > 0) then
            call dgemm('T', 'N', used, fresh, n, 1.0_wp, process%weighed, n, process%next, n, 0.0_wp, products, &
                       size(products, 1))
            call dgemm('N', 'N', n, fresh, used, -1.0_wp, process%space, n, products, size(products, 1), 1.0_wp, &
                       process%next, n)
         end if
         call operator%weigh(process%next(:, :fresh), process%next_weighed(:, :fresh))
      end associate
   end subroutine take_out

   !> Make the next vectors orthonormal one by one; they were `next triangle`. Dropped is
   !> what keeps no more than a least part of its length, that in the space included.
   pure subroutine orthonormalise_block(process, rounds, least, inside, triangle)
      type(process_t), intent(inout) :: process
      integer, intent(in) :: rounds
      real(wp), intent(in) :: least, inside(:)
      real(wp), intent(out) :: triangle(:, :)
      real(wp) :: products(size(triangle, 1)), square, whole
      integer :: i, k, n, round

      triangle = 0.0_wp
      k = 0
      n = size(process%next, 1)
      associate (v => process%next, w => process%next_weighed)
         do i = 1, process%fresh
            whole = max(dot_product(v(:, i), w(:, i)), 0.0_wp) + inside(i)**2
            do round = 1, merge(rounds, 0, k > 0)
               call dgemm('T', 'N', k, 1, n, 1.0_wp, w, n, v(:, i), n, 0.0_wp, products, k)
               call dgemm('N', 'N', n, 1, k, -1.0_wp, v, n, products, k, 1.0_wp, v(:, i), n)
               call dgemm('N', 'N', n, 1, k, -1.0_wp, w, n, products, k, 1.0_wp, w(:, i), n)
               triangle(:k, i) = triangle(:k, i) + products(:k)
            end do
            square = dot_product(v(:, i), w(:, i))
            if (.not. square > least**2*whole) cycle
            k = k + 1
            triangle(k, i) = sqrt(square)
            v(:, k) = v(:, i)/triangle(k, i)
            w(:, k) = w(:, i)/triangle(k, i)
         end do
      end associate
      process%fresh = k
   end subroutine orthonormalise_block

   !> Eigenvalues of H, whose magnitudes descend, and its eigenvectors.
   subroutine ritz_pairs(process, theta, turn, error)
      type(process_t), intent(in) :: process
      real(wp), allocatable, intent(out) :: theta(:), turn(:, :)
      type(error_t), allocatable, intent(out) :: error
      integer :: order(process%used)

      allocate (theta(process%used))
      turn = process%h(:process%used, :process%used)
      call symmetric_eigenpairs(turn, theta, error)
      if (allocated(error)) return
      order = ascending(-abs(theta))
      theta = theta(order)
      turn = turn(:, order)
   end subroutine ritz_pairs

   !> Whether the first `wanted` pairs have small residuals.
   pure logical function are_converged(process, theta, turn, wanted)
      type(process_t), intent(in) :: process
      real(wp), intent(in) :: theta(:), turn(:, :)
      integer, intent(in) :: wanted
      real(wp) :: residual(size(process%coupling, 1), wanted)

      are_converged = size(theta) >= wanted
      if (.not. are_converged) return
      residual = matmul(process%coupling(:, :process%used), turn(:, :wanted))
      are_converged = all(norm2(residual, 1) <= max(process%accuracy*abs(theta(:wanted)), noise*abs(theta(1))))
   end function are_converged

   !> Keep the Ritz vectors of the largest values alone.
   subroutine restart(process, theta, turn, wanted)
      type(process_t), intent(inout) :: process
      real(wp), intent(in) :: theta(:), turn(:, :)
      integer, intent(in) :: wanted
      integer :: kept, i

      kept = min(2*wanted + size(process%next, 2), process%used - size(process%next, 2))
      process%space(:, :kept) = product_with(process%space(:, :process%used), turn(:, :kept))
      process%weighed(:, :kept) = product_with(process%weighed(:, :process%used), turn(:, :kept))
      process%coupling(:, :kept) = matmul(process%coupling(:, :process%used), turn(:, :kept))
      process%h = 0.0_wp
      do i = 1, kept
         process%h(i, i) = theta(i)
      end do
      process%used = kept
   end subroutine restart

   function product_with(a, b) result(c)
      real(wp), intent(in), contiguous :: a(:, :), b(:, :)
      real(wp) :: c(size(a, 1), size(b, 2))

      call dgemm('N', 'N', size(a, 1), size(b, 2), size(a, 2), 1.0_wp, a, size(a, 1), b, max(1, size(b, 1)), 0.0_wp, c, &
                 size(a, 1))
   end function product_with
end module flexact_block_lanczos
