! SPDX-License-Identifier: BSD-3-Clause
!> Every request for memory in the analysis, the factorisation and the solution fails in turn:
!> each time an error is told, and the next attempt goes well.
program test_cholesky_memory
   use, intrinsic :: iso_c_binding, only: c_int
   use flexact_cholesky_error, only: error_of_cholesky
   use flexact_cholesky, only: cholesky_t, get_pivots
   use flexact_cholesky_oracle, only: lower_t, lower_of, analyse_for, factorise_by, nested_grid
   use flexact_error, only: error_t, is_kind, error_memory
   use flexact_kinds, only: wp
   use flexact_supernodal_solve, only: solve
   use flexact_testing, only: tally_t
   implicit none
   interface
      subroutine fail_after(calls) bind(c, name='flexact_fail_after')
         import :: c_int
         integer(c_int), value :: calls
      end subroutine fail_after

      function calls_left() bind(c, name='flexact_calls_left') result(calls)
         import :: c_int
         integer(c_int) :: calls
      end function calls_left
   end interface
   integer, parameter :: side = 9, columns = side**2
   type(tally_t) :: tally
   integer :: calls, refused

   refused = 0
   do calls = 1, 100000
      if (goes_well(calls)) exit
      refused = refused + 1
   end do
   call tally%check(refused > 20, 'requests are met')
   call tally%check(goes_well(0), 'and it goes well in the end')
   call tally%finish()

contains

   !> Whether all requests were fulfilled.
   logical function goes_well(calls)
      integer, intent(in) :: calls
      type(lower_t) :: a
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error
      real(wp) :: x(columns, 5), bound
      integer :: order(columns), failed

      a = a_grid()
      order = nested_grid(side)
      x = 1.0_wp
      call fail_after(int(calls, c_int))
      call analyse_for(2, a, order, factor, error)
      if (.not. allocated(error)) call factorise_by(2, factor, a%value, failed, error)
      if (.not. allocated(error)) call solve(factor, x, error)
      bound = 0.0_wp
      if (.not. allocated(error)) bound = error_of_cholesky(factor, 0.0_wp)
      goes_well = calls_left() > 0 .or. calls == 0
      call fail_after(0_c_int)
      if (goes_well) then
         call tally%check(.not. allocated(error) .and. bound < 1.0e-10_wp, 'no error without a reason')
      else if (allocated(error)) then
         call tally%check(is_kind(error, error_memory), 'memory is what failed')
      else
         call tally%check(bound >= huge(bound), 'no bound without memory')
      end if
      if (allocated(error)) return
      x(:, 1) = matmul(full(a), x(:, 1))
      call tally%check(all(abs(x(:, 1) - 1) < 1.0e-10_wp), 'solved')
   end function goes_well

   function a_grid() result(a)
      type(lower_t) :: a
      real(wp) :: dense(columns, columns)
      integer :: i

      dense = 0.0_wp
      do i = 1, columns
         dense(i, i) = 5.0_wp
         if (modulo(i, side) /= 0) dense(i + 1, i) = -1.0_wp
         if (i + side <= columns) dense(i + side, i) = -1.0_wp
      end do
      a = lower_of(dense, abs(dense) > 0)
   end function a_grid

   pure function full(a) result(dense)
      type(lower_t), intent(in) :: a
      real(wp) :: dense(a%n, a%n)
      integer :: j, e

      dense = 0.0_wp
      do j = 1, a%n
         do e = a%start(j) + 1, a%start(j + 1)
            dense(a%place(e) + 1, j) = a%value(e)
            dense(j, a%place(e) + 1) = a%value(e)
         end do
      end do
   end function full
end program test_cholesky_memory
