! SPDX-License-Identifier: BSD-3-Clause
!> The singular value decomposition of a square matrix in steps: all values first, and then as many
!> vectors as are wanted. All of them are those of dgesdd; a few cost less than half as much.
module flexact_bidiagonal
   use flexact_dense, only: allocate_work, fits_integer
   use flexact_error, only: error_t, fail, error_convergence, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dbdsdc, dbdsqr, dgebrd, dormbr
   implicit none
   private
   public :: bidiagonal_t, is_worth_steps, bidiagonalise, find_all_vectors, find_lowest_vectors

   !> Below this side nearly all vectors are wanted anyway.
   integer, parameter :: least_side = 13
   real(wp), parameter :: largest_entry = 1.0e100_wp
   !> Vectors that are found at a time: each division waits for the last.
   integer, parameter :: lanes = 6
   !> Values that are nearer to each other, or to zero, than this part of the largest have vectors
   !> that are a choice, or have lost too many digits.
   real(wp), parameter :: apart = 1.0e-5_wp
   !> What good vectors leave, as a part of the matrix, and how far their halves differ in length.
   real(wp), parameter :: good = 1.0e-14_wp, rounding = 2*epsilon(1.0_wp), alike = 1.0e-9_wp
   integer, parameter :: most_steps = 4

   !> Q' A P = B, upper bidiagonal, as dgebrd leaves it: reflections in place of A, diagonal and
   !> what is beside it.
   type :: bidiagonal_t
      real(wp), allocatable :: a(:, :), of_q(:), of_p(:), d(:), e(:)
   end type bidiagonal_t

contains

   !> Whether of a square matrix a few vectors are few, and dgesdd would not scale it.
   pure logical function is_worth_steps(a)
      real(wp), intent(in) :: a(:, :)
      is_worth_steps = size(a, 1) >= least_side .and. size(a, 1) == size(a, 2)
      if (is_worth_steps) is_worth_steps = all(abs(a) < largest_entry) .and. any(abs(a) > 1/largest_entry)
   end function is_worth_steps

   !> The singular values (n) of A (n, n), descending.
   pure subroutine bidiagonalise(a, form, values, error)
      real(wp), intent(in), contiguous :: a(:, :)
      type(bidiagonal_t), intent(out) :: form
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: work(:)
      real(wp) :: length(1), beside(size(values)), none(1, 1)
      integer :: n, info

      n = size(values)
      info = 1
      if (fits_integer(n, n)) allocate (form%of_q(n), form%of_p(n), form%d(n), form%e(n), stat=info)
      if (info == 0) allocate (form%a, source=a, stat=info)
      if (info == 0) call dgebrd(n, n, form%a, n, form%d, form%e, form%of_q, form%of_p, length, -1, info)
      if (info == 0) call allocate_work(work, max(length(1), 4.0_wp*n), info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dgebrd(n, n, form%a, n, form%d, form%e, form%of_q, form%of_p, work, size(work), info)
      values = form%d
      beside = form%e
      if (info == 0) call dbdsqr('U', n, 0, 0, 0, values, beside, none, 1, none, 1, none, 1, work, info)
      if (info /= 0 .or. .not. all(values >= 0)) call fail(error_convergence, error)
   end subroutine bidiagonalise

   !> All columns of U (n, n) and rows of V' (n, n), as dgesdd gives them.
   pure subroutine find_all_vectors(form, u, vt, error)
      type(bidiagonal_t), intent(inout) :: form
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: d(size(form%d)), e(size(form%d)), none(1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n, info, no_iwork(1)

      n = size(d)
      allocate (work(max((3*n + 4)*n, 64*(n + 65))), iwork(8*n), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      d = form%d
      e = form%e
      u = 0.0_wp
      vt = 0.0_wp
      call dbdsdc('U', 'I', n, d, e, u, n, vt, n, none, no_iwork, work, iwork, info)
      if (info == 0) call dormbr('Q', 'L', 'N', n, n, n, form%a, n, form%of_q, u, n, work, size(work), info)
      if (info == 0) call dormbr('P', 'R', 'T', n, n, n, form%a, n, form%of_p, vt, n, work, size(work), info)
      if (info /= 0) call fail(error_convergence, error)
   end subroutine find_all_vectors

   !> The columns of U (n, n) and rows of V' (n, n) of the `lanes` smallest values; the others are
   !> zero. values: all, descending. is_found: false where they are not clearly apart.
   pure subroutine find_lowest_vectors(form, values, u, vt, is_found)
      type(bidiagonal_t), intent(in) :: form
      real(wp), intent(in), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      logical, intent(out) :: is_found
      real(wp) :: z(lanes, 2*size(values)), left(lanes, size(values)), right(lanes, size(values))
      integer :: k, n

      n = size(values)
      associate (low => values(n - lanes:))
         is_found = low(lanes + 1) > apart*values(1) .and. all(low(:lanes) - low(2:) > apart*values(1))
      end associate
      if (is_found) call iterate(form, values(n - lanes + 1:), z, is_found)
      if (.not. is_found) return
      right = z(:, 1::2)
      left = z(:, 2::2)
      do k = n, 1, -1
         call reflect(form%of_q(k), k, form%a(k + 1:, k), left)
      end do
      do k = n - 1, 1, -1
         call reflect(form%of_p(k), k + 1, form%a(k, k + 2:), right)
      end do
      u = 0.0_wp
      vt = 0.0_wp
      do k = 1, lanes
         u(:, n - lanes + k) = left(k, :)
         vt(n - lanes + k, :) = right(k, :)
      end do
   end subroutine find_lowest_vectors

   !> Vectors of B, its right ones in odd places and its left ones in even ones, each of unit norm, by inverse iteration: their eigenvalues in the matrix without a diagonal that
   !> has d(1), e(1), d(2), ... beside it are the singular values (Golub and Kahan, SIAM J. Numer.
   !> Anal. B 2, 1965).
   pure subroutine iterate(form, shift, z, is_found)
      type(bidiagonal_t), intent(in) :: form
      real(wp), intent(in) :: shift(lanes)
      real(wp), intent(out) :: z(:, :)
      logical, intent(out) :: is_found
      real(wp) :: beside(size(z, 2)), start(lanes), norm, right(lanes), both(lanes), least, rest
      integer :: step, i, k

      beside(1::2) = form%d
      beside(2::2) = form%e
      beside(size(beside)) = 0.0_wp
      norm = 2*maxval(abs(beside))
      least = epsilon(1.0_wp)*norm + tiny(1.0_wp)
      ! Anything without symmetry serves to begin with.
      start = [(k/(lanes + 0.7_wp), k=1, lanes)]
      do i = 1, size(z, 2)
         start = 9.7_wp*start + 0.3_wp
         start = start - int(start)
         z(:, i) = start - 0.4_wp
      end do
      is_found = .false.
      do step = 1, most_steps
         call solve(beside, shift, least, z)
         ! The shifts are exact to the last bits: mostly the first solution is as good as any other.
         is_found = residual(beside, shift, z) <= merge(rounding, good, step == 1)*norm
         if (is_found) exit
      end do
      right = sum(z(:, 1::2)**2, 2)
      both = right + sum(z(:, 2::2)**2, 2)
      rest = maxval(abs(2*right - both))
      is_found = is_found .and. rest <= alike
      if (.not. is_found) return
      do i = 1, size(z, 2)
         z(:, i) = z(:, i)/sqrt(merge(right, both - right, mod(i, 2) == 1))
      end do
   end subroutine iterate

   !> Solve with the matrix less a shift for each lane, rows exchanged where the next one is larger,
   !> to unit vectors.
   pure subroutine solve(beside, shift, least, z)
      real(wp), intent(in) :: beside(:), shift(lanes), least
      real(wp), intent(inout) :: z(lanes, size(beside))
      real(wp), dimension(lanes, size(beside)) :: inverse, first, second
      real(wp), dimension(lanes) :: p, q, x, squares, factor
      logical :: is_next(lanes)
      integer :: i, n

      n = size(beside)
      p = -shift
      q = beside(1)
      x = z(:, 1)
      do i = 1, n - 1
         is_next = abs(p) < abs(beside(i))
         inverse(:, i) = merge(beside(i), p, is_next)
         inverse(:, i) = 1/sign(max(abs(inverse(:, i)), least), inverse(:, i))
         factor = inverse(:, i)*merge(p, beside(i), is_next)
         first(:, i) = merge(-shift, q, is_next)
         second(:, i) = merge(beside(i + 1), 0.0_wp, is_next)
         p = merge(q + factor*shift, -shift - factor*q, is_next)
         q = merge(-factor*beside(i + 1), beside(i + 1), is_next)
         squares = merge(x - factor*z(:, i + 1), z(:, i + 1) - factor*x, is_next)
         z(:, i) = merge(z(:, i + 1), x, is_next)
         x = squares
      end do
      inverse(:, n) = 1/sign(max(abs(p), least), p)
      z(:, n) = x*inverse(:, n)
      squares = z(:, n)**2
      do i = n - 1, 1, -1
         x = z(:, i) - first(:, i)*z(:, i + 1)
         if (i < n - 1) x = x - second(:, i)*z(:, i + 2)
         z(:, i) = x*inverse(:, i)
         squares = squares + z(:, i)**2
      end do
      squares = 1/sqrt(max(squares, tiny(least)))
      do i = 1, n
         z(:, i) = squares*z(:, i)
      end do
   end subroutine solve

   pure real(wp) function residual(beside, shift, z) result(largest)
      real(wp), intent(in) :: beside(:), shift(lanes), z(lanes, size(beside))
      real(wp) :: left(lanes), image(lanes)
      integer :: i

      left = 0.0_wp
      do i = 1, size(beside)
         image = -shift*z(:, i)
         if (i > 1) image = image + beside(i - 1)*z(:, i - 1)
         if (i < size(beside)) image = image + beside(i)*z(:, i + 1)
         left = max(left, abs(image))
      end do
      largest = maxval(left)
   end function residual

   !> (I - tau v v') z for each lane, v = (1, rest) from place `from` on.
   pure subroutine reflect(tau, from, rest, z)
      real(wp), intent(in) :: tau, rest(:)
      integer, intent(in) :: from
      real(wp), intent(inout) :: z(:, :)
      real(wp) :: along(lanes)
      integer :: i

      along = z(:, from)
      do i = 1, size(rest)
         along = along + rest(i)*z(:, from + i)
      end do
      along = tau*along
      z(:, from) = z(:, from) - along
      do i = 1, size(rest)
         z(:, from + i) = z(:, from + i) - rest(i)*along
      end do
   end subroutine reflect
end module flexact_bidiagonal
