! SPDX-License-Identifier: BSD-3-Clause
!> What is wrong with the factor of a random matrix, if anything is.
module flexact_pattern_checks
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_cholesky_error, only: error_of_cholesky
   use flexact_cholesky, only: cholesky_t, get_pivots
   use flexact_cholesky_oracle, only: lower_t, entries_of, fill_of, failing, failing_t
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_random_patterns, only: draw_t
   use flexact_supernodal_solve, only: solve
   implicit none
   private
   public :: offence_of

   real(wp), parameter :: unit = 0.5_wp*epsilon(1.0_wp)

contains

   !> Words, none where all is right. failed: as the factorisation told.
   function offence_of(draw, factor, failed) result(offence)
      type(draw_t), intent(in) :: draw
      type(cholesky_t), intent(in) :: factor
      integer, intent(in) :: failed
      character(len=:), allocatable :: offence
      logical :: is_there(factor%n, factor%n), fill(factor%n, factor%n)
      real(wp) :: dense(factor%n, factor%n)
      integer :: place_of(factor%n), j

      offence = ''
      if (factor%n /= draw%lower%n) offence = 'the number of columns'
      if (failed < 0 .or. failed > factor%n) offence = 'where it failed is no column'
      if (len(offence) > 0) return
      place_of = 0
      associate (order => factor%pattern%order)
         if (size(order) == factor%n .and. all(order >= 1 .and. order <= factor%n)) place_of(order) = [(j, j=1, factor%n)]
      end associate
      if (any(place_of == 0)) then
         offence = 'the order is none'
         return
      end if
      call spread_out(draw%lower, place_of, dense, is_there)
      fill = fill_of(is_there)
      call check_entries(draw, factor, count(fill), maxval(count(fill, 1)), offence)
      if (len(offence) > 0) return
      if (failed == 0) call check_factor(draw, factor, dense, fill, offence)
      if (len(offence) == 0) call check_end(draw, dense, fill, failed, place_of, offence)
   end function offence_of

   !> The lower triangle of the matrix in an order, and where it has entries.
   pure subroutine spread_out(a, place_of, dense, is_there)
      type(lower_t), intent(in) :: a
      integer, intent(in) :: place_of(:)
      real(wp), intent(out) :: dense(:, :)
      logical, intent(out) :: is_there(:, :)
      integer :: j, e, p, q

      dense = 0.0_wp
      is_there = .false.
      do j = 1, a%n
         do e = a%start(j) + 1, a%start(j + 1)
            p = place_of(a%place(e) + 1)
            q = place_of(j)
            dense(max(p, q), min(p, q)) = a%value(e)
            is_there(max(p, q), min(p, q)) = .true.
         end do
      end do
   end subroutine spread_out

   !> There is room for all, and the order brings forth as many as the one that was given.
   subroutine check_entries(draw, factor, entries, widest, offence)
      type(draw_t), intent(in) :: draw
      type(cholesky_t), intent(in) :: factor
      integer, intent(in) :: entries, widest
      character(len=:), allocatable, intent(inout) :: offence
      logical :: is_there(factor%n, factor%n)
      real(wp) :: dense(factor%n, factor%n)
      integer :: place_of(factor%n), j

      place_of(draw%order + 1) = [(j, j=1, factor%n)]
      call spread_out(draw%lower, place_of, dense, is_there)
      if (count(fill_of(is_there)) /= entries) offence = 'its order brings forth other entries than the one given'
      if (nint(factor%entries) < entries .or. factor%widest < widest) offence = 'no room for all entries'
      if (factor%widest > factor%n .or. nint(factor%entries) > factor%n*(factor%n + 1)/2) offence = 'more entries than there are'
   end subroutine check_entries

   !> dense: the lower triangle in the order of the factor.
   subroutine check_factor(draw, factor, dense, fill, offence)
      type(draw_t), intent(in) :: draw
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: fill(:, :)
      character(len=:), allocatable, intent(inout) :: offence
      real(wp) :: l(factor%n, factor%n), off(factor%n, factor%n), sums(factor%n, factor%n), pivot(factor%n)
      integer :: order(factor%n), terms(factor%n), i, j
      real(wp) :: largest

      call entries_of(factor, l, order)
      call get_pivots(factor, pivot)
      call multiply(l, dense, off, sums)
      terms = count(abs(l) > 0, 2)
      largest = 0.0_wp
      do j = 1, factor%n
         ! As many roundings again for the product here.
         do i = j, factor%n
            if (.not. off(i, j) <= 2*(min(terms(i), terms(j)) + 4)*unit*sums(i, j)) offence = 'residual'
            if (draw%is_exact .and. off(i, j) > 0) offence = 'whole numbers are not exact'
            if (.not. fill(i, j) .and. abs(l(i, j)) > 0) offence = 'what pads is not zero'
         end do
         largest = max(largest, norm2(off(j:, j)))
         if (.not. abs(pivot(order(j)) - l(j, j)**2) <= 2*unit*l(j, j)**2) offence = 'pivots'
      end do
      if (.not. largest <= 2*error_of_cholesky(factor, 0.0_wp)) offence = 'the bound of the error'
      if (len(offence) == 0 .and. modulo(draw%state, 4_int64) == 0) call check_solution(draw%lower, factor, l, offence)
   end subroutine check_factor

   !> |L L' - A| and |L| |L'|, lower triangles.
   pure subroutine multiply(l, dense, off, sums)
      real(wp), intent(in) :: l(:, :), dense(:, :)
      real(wp), intent(out) :: off(:, :), sums(:, :)
      integer, parameter :: few = 40
      integer :: j, k

      if (size(l, 1) > few) then
         off = matmul(l, transpose(l))
         sums = matmul(abs(l), transpose(abs(l)))
         off = abs(off - dense)
         return
      end if
      off = -dense
      sums = 0.0_wp
      do k = 1, size(l, 1)
         do j = k, size(l, 1)
            if (.not. abs(l(j, k)) > 0) cycle
            off(j:, j) = off(j:, j) + l(j:, k)*l(j, k)
            sums(j:, j) = sums(j:, j) + abs(l(j:, k)*l(j, k))
         end do
      end do
      off = abs(off)
   end subroutine multiply

   !> The residual is within the rounding of the factor and of both substitutions.
   subroutine check_solution(a, factor, l, offence)
      type(lower_t), intent(in) :: a
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: l(:, :)
      character(len=:), allocatable, intent(inout) :: offence
      real(wp) :: x(a%n, 2), left(a%n, 2), sums(a%n, 2), b(a%n, 2)
      type(error_t), allocatable :: error
      integer :: i, j, e

      do j = 1, a%n
         b(j, :) = [1.0_wp, real(modulo(7*j, 5) - 2, wp)]
      end do
      x = b
      call solve(factor, x, error)
      left = -b
      do j = 1, a%n
         do e = a%start(j) + 1, a%start(j + 1)
            i = a%place(e) + 1
            left(i, :) = left(i, :) + a%value(e)*x(j, :)
            if (i /= j) left(j, :) = left(j, :) + a%value(e)*x(i, :)
         end do
      end do
      sums(factor%pattern%order, :) = matmul(abs(l), matmul(transpose(abs(l)), abs(x(factor%pattern%order, :))))
      if (allocated(error) .or. .not. all(abs(left) <= (4*a%n + 20)*unit*(sums + abs(b)))) offence = 'the solution'
   end subroutine check_solution

   !> It ended where it must: at no column whose leading part is clearly definite, nor behind one that
   !> clearly is not.
   subroutine check_end(draw, dense, fill, failed, place_of, offence)
      type(draw_t), intent(in) :: draw
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: fill(:, :)
      integer, intent(in) :: failed, place_of(:)
      character(len=:), allocatable, intent(inout) :: offence
      type(failing_t) :: above, below
      real(wp) :: margin

      margin = 8*real(size(place_of), wp)*(size(place_of) + 4)*unit
      if (draw%is_exact) margin = 0.0_wp
      above = failing(dense, fill, margin)
      if (failed == 0) then
         if (any(above%fails)) offence = 'not definite, and that was not seen'
         return
      end if
      below = failing(dense, fill, -margin)
      associate (p => place_of(failed))
         if (above%is_lost(p)) offence = 'it failed later than it must'
         if (.not. (below%fails(p) .or. below%is_lost(p))) offence = 'it failed where it need not'
         if (draw%is_exact .and. .not. below%fails(p)) offence = 'it failed elsewhere'
      end associate
   end subroutine check_end
end module flexact_pattern_checks
