! SPDX-License-Identifier: BSD-3-Clause
!> The table of the keywords: which block each belongs to, what it does, and
!> the form of its operands.
!>
!> A form is a string of letters, one an operand, the last one repeated:
!> e element number, n node number, i component, r real, w word.
module flexact_keywords
   use flexact_element_table, only: element_kinds
   implicit none
   private
   public :: keyword_t, keywords, find_keyword, nearest_keyword, edit_distance, keyword_rows
   public :: why_uncovered, instead_of_uncovered
   public :: block_kinematics, block_dynamics, block_closed, block_inout, block_picture
   public :: role_element, role_value, role_coordinate, role_deformation, role_form, role_uncovered, role_unknown, role_picture, &
             role_property, role_load, role_ending, role_units

   integer, parameter :: block_kinematics = 1
   integer, parameter :: block_dynamics = 2
   !> Behind the second END.
   integer, parameter :: block_closed = 3
   integer, parameter :: block_inout = 4
   integer, parameter :: block_picture = 5

   !> What a statement does: makes an element; gives a node its value; gives a
   !> coordinate or a deformation its class; is read for its form alone; is
   !> known, and outside what Flexact covers; is not known at all; says how
   !> elements are drawn; gives a stiffness or a mass; gives a load; or ends a block.
   integer, parameter :: role_element = 1
   integer, parameter :: role_value = 2
   integer, parameter :: role_coordinate = 3
   integer, parameter :: role_deformation = 4
   integer, parameter :: role_form = 5
   integer, parameter :: role_uncovered = 6
   integer, parameter :: role_unknown = 7
   integer, parameter :: role_picture = 8
   integer, parameter :: role_property = 9
   integer, parameter :: role_load = 10
   integer, parameter :: role_ending = 11
   integer, parameter :: role_units = 12

   type :: keyword_t
      character(len=13) :: name
      integer :: block
      integer :: role
      character(len=4) :: form
      !> How many operands at the least and at the most.
      integer :: least
      integer :: most
   end type keyword_t

   integer, parameter :: any_number = huge(1)
   integer, parameter :: kin = block_kinematics
   integer, parameter :: dyn = block_dynamics
   integer, parameter :: pic = block_picture
   integer, parameter :: form = role_form
   integer, parameter :: draw = role_picture
   integer, parameter :: give = role_property
   integer, parameter :: load = role_load
   integer, parameter :: no = role_uncovered

   type(keyword_t), parameter :: keywords(*) = [ &
                                 keyword_t('X', kin, role_value, 'nr', 2, 5), &
                                 keyword_t('FIX', kin, role_coordinate, 'ni', 1, any_number), &
                                 keyword_t('INPUTX', kin, role_coordinate, 'ni', 1, any_number), &
                                 keyword_t('DYNX', kin, role_coordinate, 'ni', 1, any_number), &
                                 keyword_t('RLSE', kin, role_deformation, 'ei', 1, any_number), &
                                 keyword_t('INPUTE', kin, role_deformation, 'ei', 1, any_number), &
                                 keyword_t('DYNE', kin, role_deformation, 'ei', 1, any_number), &
                                 keyword_t('UNITS', kin, role_units, 'w', 1, 1), &
                                 keyword_t('OUTLEVEL', kin, form, 'r', 1, 2), &
                                 keyword_t('PLBEAR', kin, no, 'w', 0, any_number), &
                                 keyword_t('PLBELT', kin, no, 'w', 0, any_number), &
                                 keyword_t('WHEEL', kin, no, 'w', 0, any_number), &
                                 keyword_t('PLWHEEL', kin, no, 'w', 0, any_number), &
                                 keyword_t('ENHC', kin, no, 'w', 0, any_number), &
                                 keyword_t('EM', dyn, give, 'er', 2, any_number), &
                                 keyword_t('EMASS', dyn, give, 'er', 2, any_number), &
                                 keyword_t('ESTIFF', dyn, give, 'er', 2, any_number), &
                                 keyword_t('STRENGTH', dyn, give, 'er', 2, any_number), &
                                 keyword_t('EXPANSION', dyn, give, 'er', 2, any_number), &
                                 keyword_t('FILLET', dyn, give, 'er', 2, any_number), &
                                 keyword_t('EDAMP', dyn, form, 'er', 2, any_number), &
                                 keyword_t('EDAMPP', dyn, form, 'er', 2, any_number), &
                                 keyword_t('ESIG', dyn, form, 'er', 2, any_number), &
                                 keyword_t('XM', dyn, give, 'nr', 2, any_number), &
                                 keyword_t('MASS', dyn, give, 'nr', 2, any_number), &
                                 keyword_t('XF', dyn, load, 'nr', 2, any_number), &
                                 keyword_t('FORCE', dyn, load, 'nr', 2, any_number), &
                                 keyword_t('DELXF', dyn, load, 'nr', 2, any_number), &
                                 keyword_t('INPUTX', dyn, form, 'nir', 3, 5), &
                                 keyword_t('INPUTE', dyn, form, 'eir', 3, 5), &
                                 keyword_t('DELINPX', dyn, form, 'nir', 3, any_number), &
                                 keyword_t('DELINPE', dyn, form, 'eir', 3, any_number), &
                                 keyword_t('STARTDE', dyn, form, 'eir', 3, any_number), &
                                 keyword_t('STARTDX', dyn, form, 'nir', 3, any_number), &
                                 keyword_t('GRAVITY', dyn, load, 'r', 2, 3), &
                                 keyword_t('TIMESTEP', dyn, form, 'r', 2, 2), &
                                 keyword_t('ITERSTEP', dyn, form, 'r', 1, any_number), &
                                 keyword_t('ERROR', dyn, form, 'r', 1, any_number), &
                                 keyword_t('USERSIG', dyn, form, 'w', 1, any_number), &
                                 keyword_t('USERINP', dyn, form, 'w', 1, any_number), &
                                 keyword_t('INPUTF', block_inout, form, 'w', 1, any_number), &
                                 keyword_t('INX', block_inout, form, 'r', 1, any_number), &
                                 keyword_t('OUTF', block_inout, form, 'r', 1, any_number), &
                                 keyword_t('OUTX', block_inout, form, 'r', 1, any_number), &
                                 keyword_t('OUTXP', block_inout, form, 'r', 1, any_number), &
                                 keyword_t('VISUALIZATION', pic, draw, 'w', 0, any_number), &
                                 keyword_t('BEAMPROPS', pic, draw, 'e', 0, any_number), &
                                 keyword_t('CROSSTYPE', pic, draw, 'w', 1, 1), &
                                 keyword_t('CROSSDIM', pic, draw, 'r', 1, any_number), &
                                 keyword_t('SHOWJOINTS', pic, form, 'r', 1, 1), &
                                 keyword_t('GRAPHICS', pic, draw, 'e', 0, any_number), &
                                 keyword_t('FACECOLOR', pic, draw, 'r', 3, 3), &
                                 keyword_t('EDGECOLOR', pic, draw, 'r', 3, 3), &
                                 keyword_t('OPACITY', pic, draw, 'r', 1, 1), &
                                 keyword_t('LINESTYLE', pic, form, 'w', 1, any_number), &
                                 keyword_t('INITIAL', pic, form, 'w', 0, any_number), &
                                 keyword_t('COLOR', pic, form, 'r', 3, 3), &
                                 keyword_t('VISIBLE', pic, form, 'r', 1, 1), &
                                 keyword_t('DONOTDRAW', pic, draw, 'e', 1, any_number), &
                                 keyword_t('LIGHT', pic, form, 'w', 0, any_number), &
                                 keyword_t('AXISPROPS', pic, form, 'w', 0, any_number), &
                                 keyword_t('LIMITS', pic, form, 'r', 1, 6), &
                                 keyword_t('TRAJECT', pic, form, 'w', 0, any_number), &
                                 keyword_t('BEAMVIS', pic, draw, 'w', 0, any_number), &
                                 keyword_t('TRUSSVIS', pic, draw, 'w', 0, any_number)]

contains

   !> The row of the table for a word in capitals, in this block where it is
   !> there and else in any; 0 where there is none. Elements are not rows.
   pure integer function find_keyword(word, block) result(row)
      character(len=*), intent(in) :: word
      integer, intent(in) :: block
      integer :: i

      row = 0
      do i = 1, size(keywords)
         if (keywords(i)%name /= word) cycle
         row = i
         if (keywords(i)%block == block) return
      end do
   end function find_keyword

   !> The rows as words, for those who read the table from outside: name, block, role, form,
   !> and how many operands at the least and at the most, 0 for any number.
   function keyword_rows() result(rows)
      character(len=24) :: rows(size(keywords))
      type(keyword_t) :: row
      integer :: i

      do i = 1, size(keywords)
         row = keywords(i)
         write (rows(i), '(a, 2(1x, i0), 1x, a, 2(1x, i0))') trim(row%name), row%block, row%role, trim(row%form), &
            row%least, merge(0, row%most, row%most == any_number)
      end do
   end function keyword_rows

   !> Why an element is not covered.
   pure function why_uncovered(name) result(why)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: why

      select case (name)
      case ('PLBEAR', 'PLBELT')
         why = 'no public text says with certainty what it measures'
      case default
         why = 'rolling holds velocities, not positions'
      end select
   end function why_uncovered

   !> What to write instead.
   pure function instead_of_uncovered(name) result(instead)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: instead

      select case (name)
      case ('PLBEAR')
         instead = 'write PLRBEAM e p op q for the translations, or one node for p and q, and PLHINGE e op oq for the rotation'
      case ('PLBELT')
         instead = 'write a PLTRUSS for each free part of the belt, between points that PLRBEAM joins to the pulleys: '// &
                   'to first order it is the same'
      case default
         instead = 'leave it out, and hold with FIX, TRUSS or RBEAM what it holds in this configuration'
      end select
   end function instead_of_uncovered

   !> The keyword of this block that is spelt most nearly like the word; blank
   !> where none is near.
   function nearest_keyword(word, block) result(nearest)
      character(len=*), intent(in) :: word
      integer, intent(in) :: block
      character(len=13) :: nearest
      integer :: i, best

      nearest = ''
      best = 1 + max(1, min(3, len(word)/3))
      if (len(word) == 1 .or. len(word) > 20) return
      if (block == block_kinematics) then
         do i = 1, size(element_kinds)
            call consider(element_kinds(i)%keyword)
         end do
      end if
      do i = 1, size(keywords)
         if (keywords(i)%block == block .and. keywords(i)%role /= role_uncovered) call consider(keywords(i)%name)
      end do
      if (block /= block_picture) then
         call consider('END')
         call consider('HALT')
      end if

   contains

      subroutine consider(name)
         character(len=*), intent(in) :: name
         integer :: distance

         distance = edit_distance(word, trim(name))
         if (distance < best) then
            best = distance
            nearest = name
         end if
      end subroutine consider
   end function nearest_keyword

   !> How many letters to add, drop, change or swap with their neighbour
   !> (restricted Damerau-Levenshtein distance).
   pure integer function edit_distance(a, b) result(distance)
      character(len=*), intent(in) :: a, b
      integer :: d(0:len(a), 0:len(b)), i, j, change

      d(:, 0) = [(i, i=0, len(a))]
      d(0, :) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            change = merge(0, 1, a(i:i) == b(j:j))
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + change)
            if (i > 1 .and. j > 1) then
               if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) &
                  d(i, j) = min(d(i, j), d(max(i - 2, 0), max(j - 2, 0)) + 1)
            end if
         end do
      end do
      distance = d(len(a), len(b))
   end function edit_distance
end module flexact_keywords
