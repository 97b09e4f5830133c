! SPDX-License-Identifier: BSD-3-Clause
!> How the elements are to be drawn. The analysis does not use it.
module flexact_appearance
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_kinds, only: wp
   implicit none
   private
   public :: appearance_t, make_appearance
   public :: section_none, section_rect, section_circ, section_line, section_names, section_sizes

   !> Kinds of cross-section by number.
   integer, parameter :: section_none = 0
   integer, parameter :: section_rect = 1
   integer, parameter :: section_circ = 2
   integer, parameter :: section_line = 5
   !> Their names in a deck, and how many outer sizes each has.
   character(len=7), parameter :: section_names(5) = ['RECT   ', 'CIRC   ', 'RECTHOL', 'CIRCHOL', 'LINE   ']
   integer, parameter :: section_sizes(5) = [2, 1, 2, 1, 0]

   type :: appearance_t
      !> (elements) kind of cross-section.
      integer, allocatable :: cross_section(:)
      !> (2, elements) along local y and z, a diameter twice; 0 where not given.
      real(wp), allocatable :: dimensions(:, :)
      !> (3, elements) red, green, blue from 0 to 1; NaN where not given.
      real(wp), allocatable :: colour(:, :)
      real(wp), allocatable :: edge_colour(:, :)
      !> (elements) from 0 to 1; NaN where not given.
      real(wp), allocatable :: opacity(:)
      !> (elements) whether an element is drawn.
      logical, allocatable :: drawn(:)
   end type appearance_t

contains

   !> Elements of which nothing is given.
   function make_appearance(elements) result(appearance)
      integer, intent(in) :: elements
      type(appearance_t) :: appearance
      real(wp) :: not_given

      not_given = ieee_value(1.0_wp, ieee_quiet_nan)
      allocate (appearance%cross_section(elements), source=section_none)
      allocate (appearance%dimensions(2, elements), source=0.0_wp)
      allocate (appearance%colour(3, elements), source=not_given)
      allocate (appearance%edge_colour(3, elements), source=not_given)
      allocate (appearance%opacity(elements), source=not_given)
      allocate (appearance%drawn(elements), source=.true.)
   end function make_appearance
end module flexact_appearance
