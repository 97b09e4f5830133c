! SPDX-License-Identifier: BSD-3-Clause
!> Where a caller on another thread watches what is at work, and may stop it: each access is to
!> memory, not to what the compiler knows to stand there.
module flexact_progress
   use flexact_kinds, only: wp
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
      !> What is at work, per cent of it where that can be told, and what is not 0 once nobody waits for it any more.
      integer, pointer :: stage(:) => null()
   contains
      procedure :: report, advance, is_stopped
   end type progress_t

contains

   subroutine report(self, stage)
      class(progress_t), intent(in) :: self
      integer, intent(in) :: stage

      call write_to(self, 1, stage)
      call write_to(self, 2, 0)
   end subroutine report

   !> done: the part of the stage that is done, from 0 to 1.
   recursive subroutine advance(self, done)
      class(progress_t), intent(in) :: self
      real(wp), intent(in) :: done

      call write_to(self, 2, nint(100*done))
   end subroutine advance

   recursive logical function is_stopped(self)
      class(progress_t), intent(in) :: self
      integer, pointer, volatile :: there

      is_stopped = .false.
      if (.not. associated(self%stage)) return
      there => self%stage(3)
      is_stopped = there /= 0
   end function is_stopped

   recursive subroutine write_to(self, place, number)
      class(progress_t), intent(in) :: self
      integer, intent(in) :: place, number
      integer, pointer, volatile :: there

      if (.not. associated(self%stage)) return
      there => self%stage(place)
      there = number
   end subroutine write_to
end module flexact_progress
