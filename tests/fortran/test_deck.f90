! SPDX-License-Identifier: BSD-3-Clause
!> Decks as text: what a model holds afterwards, and where problems are.
program test_deck
   use flexact_deck, only: read_deck, locate
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: diagnostics_t, severity_error, severity_warning, severity_note
   use flexact_kinds, only: wp
   use flexact_model, only: class_none, class_fixed, class_dependent, class_independent
   use flexact_slots, only: node_planar_position, node_angle
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally
   character, parameter :: nl = new_line('a')

   call any_order()
   call classes_add_up()
   call planar_model()
   call numbers_may_skip()
   call dialects()
   call all_problems_in_one_run()
   call two_places()
   call places_end_with_the_statement()
   call errors_before_warnings()
   call tally%finish()

contains

   subroutine any_order()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused
      character(len=*), parameter :: deck = 'x 3 1.5 0 0'//nl//'beam 7 1 2 3 4 0 1 0 % leaf'//nl// &
                                     '# a comment'//nl//'FIX 1'//nl//'* another'//nl//'RLSE 7 2 5 6'//nl//'DYNX 4 3'//nl//'END'

      call read_deck(deck, made, unused, diagnostics)
      call tally%check(diagnostics%kept == 0, 'a deck in any order has no problems')
      associate (model => made%model, name => made%element_names(1))
         call tally%check(model%elements == 1 .and. model%nodes == 4, 'one element, four nodes')
         call tally%check(deck(name%first:name%last) == 'leaf', 'the comment of an element is its name')
         call tally%near(model%node_value(:3, 3), [1.5_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'X gives values')
         call tally%near(model%node_value(:, 2), [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'unset orientation')
         call tally%check(all(model%coordinate_class(:, 1) == class_fixed), 'FIX without components fixes all')
         call tally%check(all(model%coordinate_class(:, 4) == [class_dependent, class_independent, class_dependent]), &
                          'component 3 of an orientation is the rotation about y')
         call tally%check(all(model%deformation_class(:, 1) == [class_fixed, class_dependent, class_fixed, &
                                                                class_fixed, class_dependent, class_dependent]), 'RLSE')
      end associate
   end subroutine any_order

   subroutine classes_add_up()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('TRUSS 1 1 2'//nl//'X 2 1 0 0'//nl//'FIX 1 1'//nl//'FIX 1 2 3'//nl//'FIX 2 2'//nl//'DYNX 2 3', &
                     made, unused, diagnostics)
      call tally%check(diagnostics%kept == 0, 'statements for one node add up')
      call tally%check(all(made%model%coordinate_class == reshape( &
                           [class_fixed, class_fixed, class_fixed, class_dependent, class_fixed, class_independent], &
                           [3, 2])), 'classes of both nodes')
   end subroutine classes_add_up

   subroutine planar_model()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('PLBEAM 1 1 2 3 4'//nl//'PLTRUSS 2 3 5'//nl//'X 3 1 0'//nl//'X 5 1 1'//nl//'FIX 2', &
                     made, unused, diagnostics)
      call tally%check(diagnostics%kept == 0, 'a planar deck')
      associate (model => made%model)
         call tally%check(all(model%node_kind == [node_planar_position, node_angle, node_planar_position, node_angle, &
                                                  node_planar_position]), 'kinds of planar nodes')
         call tally%check(model%coordinate_class(3, 1) == class_none, 'a planar position has no z')
         call tally%check(all(model%coordinate_class(:, 2) == [class_none, class_none, class_fixed]), 'an angle is rz')
      end associate
   end subroutine planar_model

   subroutine numbers_may_skip()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('TRUSS 9000000 2000000000 7'//nl//'X 7 1 0 0'//nl//'FIX 7'//nl//'RLSE 9000000', made, unused, diagnostics)
      call tally%check(diagnostics%kept == 0, 'numbers far apart')
      call tally%check(all(made%model%node_number == [7, 2000000000]), 'nodes in the order of their numbers')
      call tally%check(made%model%deformation_class(1, 1) == class_dependent, 'an element found by its number')
   end subroutine numbers_may_skip

   subroutine dialects()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused
      character, parameter :: cr = achar(13), tab = achar(9)

      call read_deck('OUTLEVEL 0 1'//cr//nl//tab//'PLBEAMNL'//tab//'1 1 2 3 4'//cr//nl//cr//nl//'X 3 1D0 0.'//cr//nl// &
                     'FIX 1'//cr//nl//'END'//cr//nl//'HALT'//cr//nl//'ESIG 1 .5'//cr//nl//'END'//cr//nl//'END'//cr//nl// &
                     'VISUALIZATION'//cr//nl//'BEAMPROPS 1 ; all'//cr//nl//'CROSSTYPE RECT', made, unused, diagnostics)
      call tally%check(diagnostics%kept == 1 .and. diagnostics%count(severity_note) == 1, 'one note on what is not used')
      call tally%check(unused == 1, 'what is not used is counted')
   end subroutine dialects

   subroutine all_problems_in_one_run()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused, i, line(6), column(6)
      character(len=*), parameter :: deck = 'TRUS 1 1 2'//nl//'TRUSS 2 1'//nl//'X 2 1 0 nan'//nl//'FIX 9'//nl// &
                                     'RLSE 1 2'//nl//'DYNX 1 4'

      call read_deck(deck, made, unused, diagnostics)
      call tally%check(diagnostics%count(severity_error) == 6, 'six mistakes, six errors')
      do i = 1, min(6, diagnostics%kept)
         call locate(deck, diagnostics%item(i)%place%first, line(i), column(i))
      end do
      call tally%check(all(line == [1, 2, 3, 4, 5, 6]), 'each on its line')
      call tally%check(all(column == [1, 10, 9, 5, 8, 8]), 'each at its column')
   end subroutine all_problems_in_one_run

   subroutine two_places()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused
      character(len=*), parameter :: deck = 'TRUSS 1 1 2'//nl//'X 2 1 0 0'//nl//'X 2 2 0 0'//nl//'FIX 1'//nl//'DYNX 1 3'

      call read_deck(deck, made, unused, diagnostics)
      call tally%check(diagnostics%count(severity_warning) == 1, 'a value given twice is a warning')
      call tally%near(made%model%node_value(:1, 2), [2.0_wp], 0.0_wp, 'the last value counts')
      call tally%check(diagnostics%count(severity_error) == 1, 'fixed and independent is an error')
      call tally%check(diagnostics%item(2)%place%first == index(deck, '3', back=.true.), 'the second statement')
      call tally%check(diagnostics%item(2)%other%first == index(deck, 'FIX') + 4, 'and the first')
   end subroutine two_places

   !> Comments follow without a blank, and another statement in the next line.
   subroutine places_end_with_the_statement()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused
      character(len=*), parameter :: deck = 'TRUSS 1 1 2%one'//nl//'TRUSS 2 1 2 # two'//nl//'HINGE 2%3'//nl//'X 3 0 0 0'

      call read_deck(deck, made, unused, diagnostics)
      call tally%check(diagnostics%count(severity_error) == 5, 'two without length, one incomplete, its number taken, no node')
      associate (item => diagnostics%item)
         call tally%check(deck(item(1)%place%first:item(1)%place%last) == 'TRUSS 1 1 2', 'up to the comment')
         call tally%check(deck(item(2)%place%first:item(2)%place%last) == 'TRUSS 2 1 2', 'up to the last word')
         call tally%check(deck(item(3)%place%first:item(3)%place%last) == '2', 'the number alone')
         call tally%check(deck(item(3)%other%first:item(3)%other%last) == '2' .and. &
                          item(3)%other%first == index(deck, ' 2 1 2') + 1, 'and where it was used first')
      end associate
   end subroutine places_end_with_the_statement

   !> More warnings than are kept, and errors behind them.
   subroutine errors_before_warnings()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('TRUSS 1 1 2'//nl//repeat('X 2 1 0 0'//nl, 3000)//repeat('FIX 9'//nl, 3000), made, unused, diagnostics)
      call tally%check(all(diagnostics%count == [3000, 2999, 0]), 'all are counted')
      call tally%check(all(diagnostics%item(:diagnostics%kept)%severity == severity_error), 'errors drive out warnings')
   end subroutine errors_before_warnings
end program test_deck
