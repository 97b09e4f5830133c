! SPDX-License-Identifier: BSD-3-Clause
!> From a deck to a rank, where planar and spatial elements share nodes.
program test_shared_nodes
   use flexact_deck, only: read_deck
   use flexact_deck_model, only: deck_model_t
   use flexact_determinacy, only: analyse
   use flexact_diagnostics, only: diagnostics_t
   use flexact_kinds, only: wp
   use flexact_problem, only: problem_t
   use flexact_result, only: result_t, options_t
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally
   character, parameter :: nl = new_line('a')

   call planar_and_spatial()
   call planar_length_is_in_the_plane()
   call tally%finish()

contains

   !> A planar element sees x and y alone, whatever z its nodes have: its row is
   !> that of a bar between their shadows. Two bars leave one of three motions.
   subroutine planar_and_spatial()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      type(result_t) :: answer
      type(problem_t) :: problem
      real(wp) :: motion(3)
      real(wp), parameter :: shadow(3) = [0.9_wp, 0.1_wp, 0.0_wp], bar(3) = [1.0_wp, -0.4_wp, -0.3_wp]
      integer :: unused

      call read_deck('PLTRUSS 1 1 3'//nl//'TRUSS 2 3 5'//nl//'X 1 0.1 0.2'//nl//'X 3 1 0.3 0.5'//nl// &
                     'X 5 2 -0.1 0.2'//nl//'FIX 1'//nl//'FIX 5', made, unused, diagnostics)
      call tally%check(diagnostics%kept == 0, 'a deck of both kinds')
      call analyse(made%model, options_t(), problem, answer)
      call tally%check(problem%matrix%by_column%rows == 2 .and. problem%matrix%by_column%columns == 3 .and. &
                       answer%decision%rank == 2, 'rank of both')
      motion = 0.0_wp
      motion(answer%motions%place(:answer%motions%entries())) = answer%motions%value(:answer%motions%entries())
      call tally%near([dot_product(motion, shadow), dot_product(motion, bar)], [0.0_wp, 0.0_wp], &
                      1.0e-15_wp, 'the motion keeps both lengths')
   end subroutine planar_and_spatial

   subroutine planar_length_is_in_the_plane()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('PLBEAM 1 1 2 3 4'//nl//'TRUSS 2 3 5'//nl//'TRUSS 3 1 5'//nl//'X 3 0 0 1'//nl//'X 5 2 0 0', &
                     made, unused, diagnostics)
      call tally%check(diagnostics%kept == 1, 'one error')
      call tally%check(diagnostics%item(1)%code == 'zero-length', 'no length in its own plane')
   end subroutine planar_length_is_in_the_plane
end program test_shared_nodes
