! SPDX-License-Identifier: BSD-3-Clause
!> Where a caller on another thread watches what is at work.
module flexact_progress
   implicit none
   private
   public :: progress_t
   public :: stage_assembling, stage_ordering, stage_factorising, stage_motions, stage_stresses, stage_values, &
             stage_exact_rank, stage_names

   integer, parameter :: stage_assembling = 0
   integer, parameter :: stage_ordering = 1
   integer, parameter :: stage_factorising = 2
   integer, parameter :: stage_motions = 3
   integer, parameter :: stage_stresses = 4
   integer, parameter :: stage_values = 5
   integer, parameter :: stage_exact_rank = 6
   character(len=24), parameter :: stage_names(0:6) = [character(len=24) :: &
                                                       'assembling', 'ordering', 'factorising', 'motions', 'self-stresses', &
                                                       'singular values', 'exact rank']

   type :: progress_t
      !> What is at work, and per cent of it, which no stage can tell yet.
      integer, pointer :: stage(:) => null()
   contains
      procedure :: report
   end type progress_t

contains

   subroutine report(self, stage)
      class(progress_t), intent(in) :: self
      integer, intent(in) :: stage

      if (associated(self%stage)) self%stage = [stage, 0]
   end subroutine report
end module flexact_progress
