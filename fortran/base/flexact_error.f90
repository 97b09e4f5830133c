! SPDX-License-Identifier: BSD-3-Clause
!> Failures as values: a procedure that can fail has an allocatable argument,
!> which is allocated if it did; nothing else that it returns is to be used then.
module flexact_error
   implicit none
   private
   public :: error_t, fail, is_kind
   public :: error_convergence, error_memory, error_not_found, error_not_definite, &
             error_interrupted, error_names

   !> LAPACK gave up, or the matrix holds a number that is not finite.
   integer, parameter :: error_convergence = 1
   !> The work arrays cannot be had, or are too long for LAPACK's integers.
   integer, parameter :: error_memory = 2
   !> Fewer vectors were found than there must be.
   integer, parameter :: error_not_found = 3
   !> A factorisation met a pivot that is not positive.
   integer, parameter :: error_not_definite = 4
   !> Nobody waits for the result any more.
   integer, parameter :: error_interrupted = 5

   character(len=24), parameter :: error_names(0:5) = [character(len=24) :: &
                                                       'none', 'convergence', 'memory', 'not found', &
                                                       'not definite', 'interrupted']
   character(len=*), parameter :: words_of(5) = [character(len=60) :: &
                                                 'the decomposition did not converge', &
                                                 'memory does not suffice', &
                                                 'fewer vectors were found than there must be', &
                                                 'the matrix is not positive definite', &
                                                 'the work was stopped']

   type :: error_t
      !> One of those above.
      integer :: kind = 0
      character(len=:), allocatable :: words
   end type error_t

contains

   pure subroutine fail(kind, error)
      integer, intent(in) :: kind
      type(error_t), allocatable, intent(out) :: error

      allocate (error)
      error%kind = kind
      error%words = trim(words_of(kind))
   end subroutine fail

   !> Whether there is an error, and of this kind.
   pure logical function is_kind(error, kind)
      type(error_t), allocatable, intent(in) :: error
      integer, intent(in) :: kind

      is_kind = allocated(error)
      if (is_kind) is_kind = error%kind == kind
   end function is_kind
end module flexact_error
