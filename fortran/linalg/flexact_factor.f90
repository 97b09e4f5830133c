! SPDX-License-Identifier: BSD-3-Clause
!> All that is asked of a sparse Cholesky factorisation, and which one answers: the supernodal
!> one. tests/second_opinion puts a module of this name over CHOLMOD in its place.
module flexact_factor
   use flexact_cholesky_error, only: error_of_factor => error_of_cholesky
   use flexact_cholesky, only: factor_t => cholesky_t, analyse, get_pivots
   use flexact_multifrontal, only: factorise
   use flexact_supernodal_solve, only: solve
   implicit none
   private
   public :: factor_t, analyse, factorise, get_pivots, error_of_factor, solve, release

contains

   subroutine release(factor)
      type(factor_t), intent(inout) :: factor

      if (allocated(factor%value)) deallocate (factor%value)
   end subroutine release
end module flexact_factor
