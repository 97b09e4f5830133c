! SPDX-License-Identifier: BSD-3-Clause
!> The picture block of decks: what the appearance holds afterwards, and what is reported.
program test_picture
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use flexact_deck, only: read_deck
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: diagnostics_t, severity_error, severity_warning, severity_note
   use flexact_kinds, only: wp
   use flexact_appearance, only: section_none, section_rect, section_circ, section_line, section_names, section_sizes
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally
   character, parameter :: nl = new_line('a')
   !> Two beams and two bars, numbered 1, 4, 7 and 9.
   character(len=*), parameter :: model = 'BEAM 1 1 2 3 4'//nl//'BEAM 4 3 4 5 6'//nl//'TRUSS 7 1 3'//nl// &
                                  'TRUSS 9 1 5'//nl//'X 3 1 0 0'//nl//'X 5 1 1 0'//nl//'FIX 1'//nl//'END'//nl// &
                                  'HALT'//nl//'END'//nl//'VISUALIZATION'//nl
   type(deck_model_t) :: made
   type(diagnostics_t) :: diagnostics
   integer :: unused

   call no_picture()
   call groups_and_options()
   call the_last_counts()
   call sizes_follow_the_kind()
   call older_spellings()
   call what_is_not_drawn()
   call unknown_groups()
   call mistakes_are_left_out()
   call missing_elements_are_errors()
   call tally%finish()

contains

   subroutine read_with(picture)
      character(len=*), intent(in) :: picture

      diagnostics = diagnostics_t()
      call read_deck(model//picture, made, unused, diagnostics)
   end subroutine read_with

   subroutine no_picture()
      diagnostics = diagnostics_t()
      call read_deck('TRUSS 1 1 2'//nl//'X 2 1 0 0'//nl//'FIX 1'//nl//'END'//nl//'HALT'//nl//'ESIG 1 1', &
                     made, unused, diagnostics)
      call tally%check(.not. allocated(made%appearance), 'no picture block, no appearance')
      call tally%check(unused == 1, 'the stress is not used')
   end subroutine no_picture

   subroutine groups_and_options()
      integer :: i

      call read_with('OPACITY .5'//nl//'BEAMPROPS 1 7'//nl//'CROSSTYPE rect'//nl//'CROSSDIM 1D-3 0.04 ; y, z'//nl// &
                     'GRAPHICS'//nl//'FACECOLOR 0 51 255'//nl//'GRAPHICS 4 4'//nl//'EDGECOLOR 0.25 1 0'//nl//'DONOTDRAW 9 7')
      call tally%check(diagnostics%kept == 0 .and. unused == 0, 'all is used')
      associate (appearance => made%appearance)
         call tally%check(all(appearance%cross_section == [section_rect, section_none, section_rect, section_none]), 'kinds')
         call tally%near([appearance%dimensions(:, 1), appearance%dimensions(:, 3)], [0.001_wp, 0.04_wp, 0.001_wp, 0.04_wp], &
                         0.0_wp, 'local y first')
         call tally%check(all(abs(appearance%dimensions(:, 2)) <= 0.0_wp), 'no sizes elsewhere')
         call tally%near(reshape(appearance%colour, [12]), [(0.0_wp, 0.2_wp, 1.0_wp, i=1, 4)], &
                         0.0_wp, 'a group of all, from 0 to 255')
         call tally%near(appearance%edge_colour(:, 2), [0.25_wp, 1.0_wp, 0.0_wp], 0.0_wp, 'colour from 0 to 1')
         call tally%check(all(ieee_is_nan(appearance%edge_colour(:, 1))), 'not given')
         call tally%near(appearance%opacity, [0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp], 0.0_wp, 'before any group: all')
         call tally%check(all(appearance%drawn .eqv. [.true., .true., .false., .false.]), 'DONOTDRAW')
      end associate
   end subroutine groups_and_options

   subroutine the_last_counts()
      call read_with('BEAMPROPS 1 4'//nl//'CROSSTYPE CIRC'//nl//'CROSSDIM .1'//nl//'BEAMPROPS 4'//nl//'CROSSDIM .2'//nl// &
                     'GRAPHICS 1'//nl//'FACECOLOR 1 0 0'//nl//'GRAPHICS'//nl//'FACECOLOR 0 1 0')
      call tally%near(made%appearance%dimensions(1, :2), [0.1_wp, 0.2_wp], 0.0_wp, 'the last size')
      call tally%check(all(made%appearance%cross_section(:2) == section_circ), 'the kind of the group before')
      call tally%near(made%appearance%colour(:, 1), [0.0_wp, 1.0_wp, 0.0_wp], 0.0_wp, 'the last colour')
   end subroutine the_last_counts

   !> Sizes before the kind, walls behind the sizes, and sizes without a kind.
   subroutine sizes_follow_the_kind()
      call read_with('BEAMPROPS 1'//nl//'CROSSDIM .1 .2 .01 .02'//nl//'CROSSTYPE RECTHOL'//nl// &
                     'BEAMPROPS 4'//nl//'CROSSTYPE CIRCHOL'//nl//'CROSSDIM .3 .01'//nl//'BEAMPROPS 7'//nl//'CROSSDIM .4'//nl// &
                     'BEAMPROPS 9'//nl//'CROSSDIM .5 .6')
      call tally%check(diagnostics%kept == 0, 'walls are read')
      call tally%check(all(section_names(made%appearance%cross_section) == ['RECTHOL', 'CIRCHOL', 'CIRC   ', 'RECT   ']), &
                       'one number is a diameter, two are a rectangle')
      call tally%near(reshape(made%appearance%dimensions, [8]), [0.1_wp, 0.2_wp, 0.3_wp, 0.3_wp, 0.4_wp, 0.4_wp, 0.5_wp, 0.6_wp], &
                      0.0_wp, 'outer sizes, a diameter twice')
      call tally%check(all(section_sizes == [2, 1, 2, 1, 0]), 'how many outer sizes')
      call read_with('CROSSTYPE LINE')
      call tally%check(all(made%appearance%cross_section == section_line), 'a line has no size')
      call tally%check(all(abs(made%appearance%dimensions) <= 0.0_wp), 'and gets none')
   end subroutine sizes_follow_the_kind

   subroutine older_spellings()
      call read_with('BEAMVIS .1 .2'//nl//'BEAMVIS CIRC 4 .3'//nl//'TRUSSVIS 9 .4 .5')
      call tally%check(diagnostics%kept == 0 .and. unused == 0, 'BEAMVIS and TRUSSVIS')
      call tally%check(all(made%appearance%cross_section == [section_rect, section_circ, section_none, section_rect]), &
                       'all beams, one beam, one bar')
      call tally%near(reshape(made%appearance%dimensions, [8]), [0.1_wp, 0.2_wp, 0.3_wp, 0.3_wp, 0.0_wp, 0.0_wp, 0.4_wp, 0.5_wp], &
                      0.0_wp, 'their sizes')
   end subroutine older_spellings

   subroutine what_is_not_drawn()
      call read_with('GRAPHICS 1'//nl//'FACECOLOR 1 0 0'//nl//'LINESTYLE -'//nl//'INITIAL'//nl//'COLOR 0 0 1'//nl// &
                     'FACECOLOR 0 0 1'//nl//'LIGHT'//nl//'AXISPROPS'//nl//'LIMITS 0 1'//nl//'TRAJECT 1')
      call tally%near(made%appearance%colour(:, 1), [1.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'INITIAL paints no element')
      call tally%check(unused == 8 .and. diagnostics%count(severity_note) == 1, 'and is counted as not used')
   end subroutine what_is_not_drawn

   subroutine unknown_groups()
      call read_with('BEAMPROPS 1'//nl//'CROSSTYPE RECT'//nl//'WHEELPROPS 4'//nl//'CROSSTYPE CIRC'//nl//'GRAPHIC 7'//nl// &
                     'FACECOLOR 1 0 0'//nl//'BEAMPROPS 4'//nl//'SHINE 3'//nl//'CROSSTYPE LINE')
      call tally%check(all(made%appearance%cross_section == [section_rect, section_line, section_none, section_none]), &
                       'options of an unknown group are nobody''s, an unknown option changes nothing')
      call tally%check(all(ieee_is_nan(made%appearance%colour)), 'nor of one that is misspelt')
      call tally%check(diagnostics%count(severity_warning) == 3 .and. unused == 2, 'three are reported, two not used')
   end subroutine unknown_groups

   subroutine mistakes_are_left_out()
      call read_with('GRAPHICS 1'//nl//'FACECOLOR 0 256 0'//nl//'FACECOLOR 0 -.1 0'//nl//'FACECOLOR 0 1'//nl// &
                     'OPACITY 1.01'//nl//'BEAMPROPS 1'//nl//'CROSSTYPE CIRCLE'//nl//'CROSSDIM 0'//nl//'CROSSDIM 1 -1'//nl// &
                     'CROSSDIM 1 nan'//nl//'CROSSDIM'//nl//'BEAMVIS 5 .1 .1'//nl//'DONOTDRAW'//nl//'BEAMPROPS 4 7'//nl// &
                     'CROSSTYPE RECT'//nl//'CROSSDIM 1'//nl//'BEAMPROPS 9'//nl//'CROSSTYPE CIRC'//nl//'CROSSDIM .1 .2')
      call tally%check(.not. diagnostics%has_errors(), 'a picture stops no analysis')
      call tally%check(diagnostics%count(severity_warning) == 13, 'each mistake is reported once')
      associate (appearance => made%appearance)
         call tally%check(all(appearance%cross_section == [section_none, section_rect, section_rect, section_circ]), 'kinds')
         call tally%near(appearance%dimensions(1, :), [0.0_wp, 0.0_wp, 0.0_wp, 0.1_wp], 0.0_wp, 'sizes')
         call tally%check(all(ieee_is_nan(appearance%colour)) .and. all(ieee_is_nan(appearance%opacity)), 'no colour')
         call tally%check(all(appearance%drawn), 'all are drawn')
      end associate
   end subroutine mistakes_are_left_out

   subroutine missing_elements_are_errors()
      call read_with('BEAMPROPS 2'//nl//'GRAPHICS 1 8'//nl//'DONOTDRAW 3')
      call tally%check(diagnostics%count(severity_error) == 3, 'three elements that do not exist')
   end subroutine missing_elements_are_errors
end program test_picture
