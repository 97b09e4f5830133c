! SPDX-License-Identifier: BSD-3-Clause
!> The sparse Cholesky factorisation of SuiteSparse (Chen, Davis, Hager,
!> Rajamanickam, ACM Trans. Math. Softw. 35, 2008).
!> Indices count from 0; matrices are lower triangles, column by column.
module flexact_cholmod
   use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr
   implicit none
   private
   public :: cholmod_analyse, cholmod_factor, cholmod_pivots, cholmod_error, &
             cholmod_solve, cholmod_free

   interface
      !> Symbolic analysis: entries of the factor and of its longest column; null where
      !> memory does not suffice.
      function cholmod_analyse(n, start, place, order, entries, widest) bind(c, name='flexact_cholmod_analyse') &
         result(handle)
         import :: c_int, c_double, c_ptr
         integer(c_int), value :: n
         integer(c_int), intent(in) :: start(*), place(*), order(*)
         real(c_double), intent(out) :: entries
         integer(c_int), intent(out) :: widest
         type(c_ptr) :: handle
      end function cholmod_analyse

      !> 0, the column (from 1) where the matrix is not positive definite, or -1.
      function cholmod_factor(handle, n, start, place, value) bind(c, name='flexact_cholmod_factor') result(status)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: handle
         integer(c_int), value :: n
         integer(c_int), intent(in) :: start(*), place(*)
         real(c_double), intent(in) :: value(*)
         integer(c_int) :: status
      end function cholmod_factor

      !> Squares of the diagonal of the factor, in the order of the matrix.
      subroutine cholmod_pivots(handle, pivot) bind(c, name='flexact_cholmod_pivots')
         import :: c_double, c_ptr
         type(c_ptr), value :: handle
         real(c_double), intent(out) :: pivot(*)
      end subroutine cholmod_pivots

      !> By how much L L' may differ from what was factorised, in the 2-norm. unit: of
      !> rounding; extra: roundings of an entry beside those of its products.
      function cholmod_error(handle, unit, extra, enough) bind(c, name='flexact_cholmod_error') result(bound)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: handle
         real(c_double), value :: unit
         integer(c_int), value :: extra
         real(c_double), value :: enough
         real(c_double) :: bound
      end function cholmod_error

      function cholmod_solve(handle, n, k, b, x) bind(c, name='flexact_cholmod_solve') result(status)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: handle
         integer(c_int), value :: n, k
         real(c_double), intent(in) :: b(*)
         real(c_double), intent(out) :: x(*)
         integer(c_int) :: status
      end function cholmod_solve

      subroutine cholmod_free(handle) bind(c, name='flexact_cholmod_free')
         import :: c_ptr
         type(c_ptr), value :: handle
      end subroutine cholmod_free
   end interface
end module flexact_cholmod
