! SPDX-License-Identifier: BSD-3-Clause
!> What the warnings about a sound model rest on: equal texts, orders and sets, names of
!> parts; and the warnings themselves on small decks. tests/python/test_silent_mistakes.py
!> goes through all of them.
program test_silent_mistakes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use flexact_deck, only: read_deck
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_equal_texts, only: find_equal_texts
   use flexact_kinds, only: wp
   use flexact_labels, only: names_t, part_name, quoted_name
   use flexact_sorting, only: ascending, by_number, join, root_of
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   character, parameter :: nl = new_line('a')

   call orders()
   call sets()
   call texts()
   call parts()
   call long_names()
   call warnings()
   call hinges_alone()
   call properties()
   call tally%finish()

contains

   !> Against the sort by comparison, which is stable too.
   subroutine orders()
      integer :: keys(1000), none(0)
      real(wp) :: random(1000)

      call set_random()
      call random_number(random)
      keys = int(20*random)
      call tally%check(all(by_number(keys, 19) == ascending(real(keys, wp))), 'by_number sorts, and keeps the order of equal ones')
      call tally%check(size(by_number(none, 5)) == 0, 'nothing to sort')
   end subroutine orders

   subroutine sets()
      integer :: parent(6), root(6), i

      parent = [(i, i=1, 6)]
      call join(parent, 5, 2)
      call join(parent, 6, 5)
      call join(parent, 3, 4)
      call join(parent, 6, 2)
      do i = 1, 6
         call root_of(parent, i, root(i))
      end do
      call tally%check(all(root == [1, 2, 3, 3, 2, 2]), 'sets that are joined have one root, the smallest member')
   end subroutine sets

   subroutine texts()
      character(len=*), parameter :: text = 'legarm legleg l'
      integer :: group(7), groups

      ! "leg", "arm", nothing, "leg", "leg ", "l", "leg"
      call find_equal_texts(text, [span_t(1, 3), span_t(4, 6), span_t(), span_t(8, 10), span_t(11, 14), &
                                   span_t(15, 15), span_t(11, 13)], group, groups)
      call tally%check(groups == 4, 'blanks at the end of a text count')
      call tally%check(all(group == [1, 2, 0, 1, 3, 4, 1]), 'groups of equal texts')
   end subroutine texts

   subroutine parts()
      call expect_part('sheet 1, 3', 'sheet 1')
      call expect_part('sheet 1 ,  12', 'sheet 1')
      call expect_part('sheet, part 1 of 4', 'sheet')
      call expect_part('a, b, 2', 'a, b')
      call expect_part('sheet 1', 'sheet 1')
      call expect_part('left, upper', 'left, upper')
      call expect_part('leg,', 'leg,')
      call expect_part(', 1', ', 1')
      call expect_part('leg, part of 4', 'leg, part of 4')
      call expect_part('leg, part x of 4', 'leg, part x of 4')
      call expect_part('leg, 1 of 4', 'leg, 1 of 4')
      call expect_part('leg, 1.5', 'leg, 1.5')
      call expect_part('element 12 beam 3', 'element 12')
      call expect_part('element 12 beam', 'element 12 beam')
      call expect_part('element x beam 3', 'element x beam 3')
      call expect_part('cross beam 3', 'cross beam 3')
   end subroutine parts

   subroutine expect_part(name, part)
      character(len=*), intent(in) :: name, part
      character(len=len(name)), target :: text
      type(names_t) :: names
      type(span_t) :: found

      text = name
      names%text => text
      allocate (names%element(1), source=span_t(1, len(name)))
      found = part_name(names, 1)
      call tally%check(name(found%first:found%last) == part .and. found%last == len(part), 'the part of '//name)
   end subroutine expect_part

   !> A name of many bytes ends with a whole character: two bytes each here.
   subroutine long_names()
      character(len=*), parameter :: letter = char(195)//char(188)
      character(len=:), allocatable :: quoted

      quoted = quoted_name(repeat(letter, 40))
      call tally%check(quoted == "'"//repeat(letter, 22)//"...'", 'a long name is cut between characters')
      quoted = quoted_name('a'//repeat(letter, 40))
      call tally%check(quoted == "'a"//repeat(letter, 22)//"...'", 'likewise one letter further')
      call tally%check(quoted_name(repeat(letter, 24)) == "'"//repeat(letter, 24)//"'", 'a name that fits')
   end subroutine long_names

   subroutine warnings()
      character(len=*), parameter :: guide = 'BEAM 1 1 2 3 4 % leg'//nl//'X 3 1 0 0'//nl//'RLSE 1 5'//nl
      character(len=*), parameter :: ground = 'FIX 1'//nl//'FIX 2'//nl

      call expect(guide//ground, '')
      call expect(guide, 'no-support')
      call expect(guide//ground//'BEAM 2 5 6 7 8'//nl//'X 5 1 0 0'//nl//'X 7 1 1 0'//nl//'RLSE 2 5', 'coincident-nodes')
      call expect(guide//ground//'BEAM 2 5 6 7 8'//nl//'X 5 1 0 0'//nl//'X 7 1 1 0'//nl//'PINBODY 3 3 4 5', '')
      call expect(guide//ground//'BEAM 2 3 4 1 2'//nl//'RLSE 2 6', 'same-part-twice')
      call expect(guide//ground//'RBEAM 2 3 4 1', 'beside-rigid-link')
      call expect(guide//ground//'BEAM 2 5 6 7 8 % leg'//nl//'X 5 1 1 0'//nl//'X 7 1 2 0', 'repeated-name')
      call expect(guide//ground//'TRUSS 2 3 5'//nl//'X 5 1002 0 0', 'lengths-differ')
      call expect('BEAM 1 1 2 3 4'//nl//'X 3 1 1 3'//nl//'RLSE 1 3'//nl//ground, '')
      call expect('BEAM 1 1 2 3 4'//nl//'X 3 1 1.0000000001 3'//nl//'RLSE 1 3'//nl//ground, 'nearly-equal-components')
      call expect('BEAM 1 1 2 3 4'//nl//'X 3 1 1.0000000001 3'//nl//'RLSE 1 3 5'//nl//ground, '')
      call expect('BEAM 1 1 2 3 4'//nl//'X 3 1 1.00000001 3'//nl//'RLSE 1 3'//nl//ground, '')
      call expect('HINGE 1 1 2 1 1.0000000001 3'//nl//'RLSE 1 2'//nl//'FIX 1', 'nearly-equal-components')
      call expect('HINGE 1 1 2 1 1.0000000001 3'//nl//'RLSE 1 1'//nl//'FIX 1', '')
      call expect('PLRBEAM 1 1 2 3'//nl//'X 3 1 1'//nl//'RLSE 1 2'//nl//ground, '')
      call expect('BEAM 1 1 2 3 4'//nl//'X 1 0 0 0.2'//nl//'X 3 0.1 0 0.3'//nl//'RLSE 1 3'//nl//ground, '')
      call expect(guide//ground//'TRUSS 2 3 5'//nl//'X 5 1001 0 0', '')
   end subroutine warnings

   !> No node has a place, so that nothing has an extent.
   subroutine hinges_alone()
      call expect('HINGE 1 1 2 0 0 1'//nl//'FIX 1', '')
      call expect('HINGE 1 1 2 0 0 1'//nl//'HINGE 2 2 1 1 0 0'//nl//'FIX 1', 'same-part-twice')
   end subroutine hinges_alone

   !> One problem of this code, or none.
   subroutine expect(text, code)
      character(len=*), intent(in) :: text, code
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck(text, made, unused, diagnostics)
      if (code == '') then
         call tally%check(diagnostics%kept == 0, 'nothing is said of '//text)
      else if (diagnostics%kept /= 1) then
         call tally%check(.false., 'one problem of '//text)
      else
         call tally%check(diagnostics%item(1)%code == code, code//' of '//text)
      end if
   end subroutine expect

   subroutine properties()
      type(deck_model_t) :: made
      type(diagnostics_t) :: diagnostics
      integer :: unused

      call read_deck('BEAM 1 1 2 3 4'//nl//'X 3 1 0 0'//nl//'FIX 1'//nl//'END'//nl//'ESTIFF 1 1 2 3 4 5 6'//nl// &
                     'EMASS 1 7 8'//nl//'XM 4 9', made, unused, diagnostics)
      call tally%check(unused == 0 .and. diagnostics%kept == 0, 'stiffness and mass are used')
      associate (given => made%properties)
         call tally%near(given%stiffness(:, 1), real([1, 2, 3, 4, 5, 6], wp), 0.0_wp, 'ESTIFF')
         call tally%near(given%mass(:2, 1), [7.0_wp, 8.0_wp], 0.0_wp, 'EMASS')
         call tally%near(given%node_mass(:1, 4), [9.0_wp], 0.0_wp, 'XM')
         call tally%check(count(ieee_is_nan(given%mass)) == 3 .and. count(ieee_is_nan(given%node_mass)) == 23, &
                          'NaN where not given')
      end associate
   end subroutine properties
end program test_silent_mistakes
