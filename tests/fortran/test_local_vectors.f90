! SPDX-License-Identifier: BSD-3-Clause
!> Null spaces as vectors that live on few places: found there, taken apart, made
!> orthonormal.
program test_local_vectors
   use flexact_complete_pivoting, only: eliminate
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_local_vectors, only: find_local_vectors, find_scattered_vectors
   use flexact_scaled_basis, only: add_scaled, add_scaled_sparse
   use flexact_sparse, only: sparse_t, operator_of, times
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   use flexact_test_matrices, only: identity, banded, sparse_of, path, random_orthogonal
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call mechanisms_come_apart()
   call vectors_that_touch_keep_their_span()
   call eliminating_few()
   call modes_are_orthonormal()
   call modes_are_scaled()
   call sparse_modes_are_orthonormal()
   call a_sparse_vector_keeps_its_direction()
   call hundreds_of_local_vectors()
   call what_is_not_local_is_left()
   call columns_without_entries()
   call scattered_vectors()
   call nothing_scattered()
   call tally%finish()

contains

   !> A basis as a matrix (n, vectors).
   function dense_of(basis, n) result(dense)
      type(sparse_basis_t), intent(in) :: basis
      integer, intent(in) :: n
      real(wp) :: dense(n, basis%vectors)
      integer :: k

      dense = 0.0_wp
      do k = 1, basis%vectors
         associate (from => basis%start(k), to => basis%start(k + 1) - 1)
            dense(basis%place(from:to), k) = basis%value(from:to)
         end associate
      end do
   end function dense_of

   subroutine check_orthonormal(vectors, name)
      real(wp), intent(in) :: vectors(:, :)
      character(len=*), intent(in) :: name
      call tally%near([matmul(transpose(vectors), vectors)], [identity(size(vectors, 2))], 1.0e-14_wp, name)
   end subroutine check_orthonormal

   !> Whether vectors are in the span of orthonormal ones.
   subroutine check_span(vectors, orthonormal, tolerance, name)
      real(wp), intent(in) :: vectors(:, :), orthonormal(:, :), tolerance
      character(len=*), intent(in) :: name
      call tally%check(all(abs(vectors - matmul(orthonormal, matmul(transpose(orthonormal), vectors))) <= tolerance), name)
   end subroutine check_span

   !> Three vectors that share no places.
   function apart() result(vectors)
      real(wp) :: vectors(9, 3)

      vectors = 0.0_wp
      vectors([1, 4], 1) = [1.0_wp, -0.5_wp]
      vectors([2, 3, 9], 2) = [0.25_wp, 1.0_wp, 0.125_wp]
      vectors([6, 8], 3) = [-1.0_wp, 0.75_wp]
   end function apart

   !> Mixed, each comes back with its largest entry made one.
   subroutine mechanisms_come_apart()
      real(wp) :: known(9, 3), vectors(9, 3)
      integer :: k, j

      known = apart()
      known(:, 3) = -known(:, 3)
      vectors = matmul(known, random_orthogonal(3))
      call eliminate(vectors)
      do k = 1, 3
         j = maxloc([(dot_product(vectors(:, j), known(:, k)), j=1, 3)], 1)
         call tally%near(vectors(:, j), known(:, k), 1.0e-14_wp, 'one mechanism')
         call tally%check(count(abs(vectors(:, j)) > 0) == count(abs(known(:, k)) > 0), 'without traces of the others')
      end do
   end subroutine mechanisms_come_apart

   subroutine vectors_that_touch_keep_their_span()
      real(wp) :: q(20, 20), vectors(20, 6)
      logical :: is_alone(20)
      integer :: i

      q = random_orthogonal(20)
      vectors = q(:, :6)
      call eliminate(vectors)
      call check_span(vectors, q(:, :6), 1.0e-13_wp, 'the span is kept')
      is_alone = [(count(abs(vectors(i, :)) > 0) == 1 .and. abs(maxval(vectors(i, :)) - 1) < 1.0e-15_wp, i=1, 20)]
      call tally%check(count(is_alone) == 6, 'each has a place of its own')
   end subroutine vectors_that_touch_keep_their_span

   subroutine eliminating_few()
      real(wp) :: none(4, 0), one(3, 1), zero(3, 2)

      call eliminate(none)
      one = reshape([1.0_wp, -4.0_wp, 1.0e-14_wp], [3, 1])
      call eliminate(one)
      call tally%near(one(:, 1), [-0.25_wp, 1.0_wp, 0.0_wp], 0.0_wp, 'one vector')
      zero = 0.0_wp
      call eliminate(zero)
      call tally%near([zero], spread(0.0_wp, 1, 6), 0.0_wp, 'zeros stay')
   end subroutine eliminating_few

   !> Two groups: the first and the third vector share a place, each of them with
   !> the fourth through it; the second is alone. Behind what is there already.
   subroutine modes_are_orthonormal()
      integer, parameter :: place(8) = [2, 3, 5, 7, 11, 13, 17, 19]
      real(wp) :: vectors(8, 4), found(20, 5), known(20, 4)
      type(sparse_basis_t) :: basis
      type(error_t), allocatable :: error
      integer :: k

      vectors = 0.0_wp
      vectors([1, 2], 1) = [1.0_wp, 2.0_wp]
      vectors([4, 5], 2) = [3.0_wp, -4.0_wp]
      vectors([2, 3], 3) = [1.0_wp, 1.0_wp]
      vectors([3, 7, 8], 4) = [1.0_wp, 5.0_wp, 1.0_wp]
      known = 0.0_wp
      known(place, :) = vectors
      call new_sparse_basis(basis)
      call basis%add([1], [1.0_wp])
      call add_scaled(vectors, place, spread(1.0_wp, 1, 8), basis, error)
      call tally%check(.not. allocated(error) .and. basis%vectors == 5, 'all vectors are there')
      found = dense_of(basis, 20)
      call check_orthonormal(found, 'orthonormal')
      call check_span(known, found(:, 2:), 1.0e-14_wp, 'the span is kept')
      call tally%check(count(abs(found(:, 1)) > 0) == 1, 'what was there stays')
      call tally%check(count([(any(abs(found([7, 11], k)) > 0), k=1, 5)]) == 1, 'a vector that shares no place stays alone')
      call tally%check(all([(ascend(basis%place(basis%start(k):basis%start(k + 1) - 1)), k=1, 5)]), 'places ascend')
   end subroutine modes_are_orthonormal

   pure logical function ascend(list)
      integer, intent(in) :: list(:)
      ascend = all(list(2:) > list(:size(list) - 1))
   end function ascend

   !> D C y = 0 gives the motion C y.
   subroutine modes_are_scaled()
      real(wp), parameter :: scale(6) = [1.0_wp, 1.0e3_wp, 2.0_wp, 1.0e-3_wp, 1.0e6_wp, 5.0_wp]
      real(wp) :: q(6, 6), vectors(6, 2), found(6, 2), unscaled(6, 2)
      type(sparse_basis_t) :: basis
      type(error_t), allocatable :: error
      integer :: i

      q = random_orthogonal(6)
      vectors = q(:, :2)
      call new_sparse_basis(basis)
      call add_scaled(vectors, [(i, i=1, 6)], scale, basis, error)
      found = dense_of(basis, 6)
      call check_orthonormal(found, 'scaled, orthonormal')
      unscaled = found/spread(scale, 2, 2)
      do i = 1, 2
         unscaled(:, i) = unscaled(:, i)/norm2(unscaled(:, i))
      end do
      call check_span(unscaled, q(:, :2), 1.0e-9_wp, 'scaled, the span')
   end subroutine modes_are_scaled

   !> A chain of vectors each of which shares a place with the next, and a chain
   !> apart from it, in turn.
   subroutine sparse_modes_are_orthonormal()
      integer, parameter :: n = 60
      real(wp), parameter :: scale(n) = 0.5_wp
      type(sparse_basis_t) :: vectors, basis
      real(wp) :: known(2*n, n - 2), found(2*n, n - 2)
      type(error_t), allocatable :: error
      integer :: k, i

      call new_sparse_basis(vectors)
      do k = 1, n - 2
         call vectors%add([k, k + 2], [1.0_wp, real(k, wp)])
      end do
      known = 0.0_wp
      known(n + 1:, :) = dense_of(vectors, n)
      call new_sparse_basis(basis)
      call add_scaled_sparse(vectors, [(n + i, i=1, n)], scale, basis, error)
      call tally%check(.not. allocated(error) .and. basis%vectors == n - 2, 'as many sparse vectors')
      found = dense_of(basis, 2*n)
      call check_orthonormal(found, 'sparse, orthonormal')
      call check_span(known/n, found, 1.0e-13_wp, 'sparse, the span is kept')
      call tally%check(all([(is_of_one_chain(basis, k), k=1, n - 2)]), 'chains that share nothing are not mixed')
   end subroutine sparse_modes_are_orthonormal

   pure logical function is_of_one_chain(basis, k)
      type(sparse_basis_t), intent(in) :: basis
      integer, intent(in) :: k

      associate (place => basis%place(basis%start(k):basis%start(k + 1) - 1))
         is_of_one_chain = all(modulo(place, 2) == modulo(place(1), 2))
      end associate
   end function is_of_one_chain

   !> Of unit length, its largest entry positive.
   subroutine a_sparse_vector_keeps_its_direction()
      type(sparse_basis_t) :: vectors, basis
      type(error_t), allocatable :: error

      call new_sparse_basis(vectors)
      call vectors%add([1, 3], [0.5_wp, -2.0_wp])
      call new_sparse_basis(basis)
      call add_scaled_sparse(vectors, [4, 6, 9], [6.0_wp, 1.0_wp, 2.0_wp], basis, error)
      call tally%check(basis%vectors == 1 .and. all(basis%place(:2) == [4, 9]), 'where it stands')
      call tally%near(basis%value(:2), [-0.6_wp, 0.8_wp], 1.0e-15_wp, 'what it is')
   end subroutine a_sparse_vector_keeps_its_direction

   !> One singular value in five is zero; its vector has four entries.
   subroutine hundreds_of_local_vectors()
      integer, parameter :: n = 1500
      real(wp) :: values(n)
      real(wp), allocatable :: left(:, :), right(:, :), found(:, :)
      integer, allocatable :: rest(:)
      type(sparse_t) :: matrix
      type(sparse_basis_t) :: local, basis
      type(error_t), allocatable :: error
      integer :: k

      values = [(merge(0.0_wp, 1.0_wp, modulo(k, 5) == 3), k=1, n)]
      call banded(values, matrix, left, right)
      associate (zero => pack([(k, k=1, n)], values <= 0))
         associate (pin => [(maxloc(abs(right(:, zero(k))), 1), k=1, size(zero))])
            call find_local_vectors(operator_of(matrix), pin, 0, local, rest)
            call tally%check(size(rest) == 0 .and. local%vectors == size(zero), 'one vector for each pin')
            found = dense_of(local, n)
            call tally%near([found(pin, :)], [identity(size(pin))], 0.0_wp, 'a one at its pin, nothing at others')
         end associate
         call new_sparse_basis(basis)
         call add_scaled_sparse(local, [(k, k=1, n)], spread(1.0_wp, 1, n), basis, error)
         found = dense_of(basis, n)
         call tally%near([sum(found**2, 1)], spread(1.0_wp, 1, size(zero)), 1.0e-14_wp, 'made unit vectors')
         call check_span(found, right(:, zero), 1.0e-12_wp, 'the null space')
      end associate
      call tally%check(maxval(local%start(2:local%vectors + 1) - local%start(:local%vectors)) <= 4, 'of few entries')
   end subroutine hundreds_of_local_vectors

   !> The null vector of a ring lives everywhere, and a fixed path has none.
   subroutine what_is_not_local_is_left()
      type(sparse_basis_t) :: found
      integer, allocatable :: rest(:)

      call find_local_vectors(operator_of(path(500, .true.)), [7], 1, found, rest)
      call tally%check(found%vectors == 0 .and. size(rest) == 1, 'a long ring')
      call tally%check(all(rest == [7]), 'its pin is left')
      call find_local_vectors(operator_of(path(200, .true.)), [7], 1, found, rest)
      call tally%check(found%vectors == 0 .and. size(rest) == 1, 'a ring that one pin may keep')
      call find_local_vectors(operator_of(path(200, .true.)), [7], 0, found, rest)
      call tally%check(found%vectors == 1 .and. size(rest) == 0, 'a ring that is sought farther out')
      call find_local_vectors(operator_of(path(20, .true.)), [7], 1, found, rest)
      call tally%check(found%vectors == 1 .and. size(rest) == 0, 'a short ring')
      call tally%near(found%value(:20), spread(1.0_wp, 1, 20), 1.0e-13_wp, 'its null vector')
      call find_local_vectors(operator_of(path(5, .false.)), [1, 4], 0, found, rest)
      call tally%check(found%vectors == 0 .and. all(rest == [1, 4]), 'pins where nothing is low')
   end subroutine what_is_not_local_is_left

   subroutine columns_without_entries()
      real(wp) :: dense(3, 3)
      type(sparse_basis_t) :: found
      integer, allocatable :: rest(:)

      dense = 0.0_wp
      dense(:, 2) = [1.0_wp, 2.0_wp, 3.0_wp]
      call find_local_vectors(operator_of(sparse_of(dense)), [3, 1], 0, found, rest)
      call tally%check(found%vectors == 2 .and. size(rest) == 0, 'columns that nothing holds')
      call tally%check(all(found%place(:2) == [3, 1]), 'move alone')
   end subroutine columns_without_entries

   !> Half the values are zero, all over the matrix: six vectors that share nothing.
   subroutine scattered_vectors()
      integer, parameter :: n = 300
      real(wp) :: values(n), image(n, 6)
      real(wp), allocatable :: left(:, :), right(:, :)
      type(sparse_t) :: matrix
      type(sparse_basis_t) :: found
      integer :: k

      values = [(real(modulo(k, 2), wp), k=1, n)]
      call banded(values, matrix, left, right)
      call find_scattered_vectors(operator_of(matrix), 6, found)
      call tally%check(found%vectors == 6, 'as many as were asked')
      associate (vectors => dense_of(found, n))
         call times(matrix, vectors, image)
         call tally%check(all(abs(image) <= 1.0e-12_wp), 'without an image')
         call tally%check(all(maxval(abs(vectors), 1) > 0.99_wp), 'with an entry')
         call tally%check(all(count(abs(vectors) > 0, 2) <= 1), 'no place twice')
         call tally%check(maxval(count(abs(vectors) > 0, 1)) <= 40, 'each in its neighbourhood')
      end associate
   end subroutine scattered_vectors

   subroutine nothing_scattered()
      type(sparse_basis_t) :: found

      call find_scattered_vectors(operator_of(path(400, .false.)), 6, found)
      call tally%check(found%vectors == 0, 'a path that is fixed has none')
   end subroutine nothing_scattered
end program test_local_vectors
