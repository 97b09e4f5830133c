! SPDX-License-Identifier: BSD-3-Clause
!> What a statement may name by number: the components of a node or the
!> deformations of an element.
module flexact_choice
   use flexact_element_table, only: element_kinds, beam_with_warping, number_of_deformations => deformations_of
   use flexact_slots, only: node_planar_position, node_position, node_angle
   use flexact_operands, only: operands_t
   implicit none
   private
   public :: choice_t, components_of, deformations_of, warping_components, take_choice

   !> What there is to name, and which entry of the classes each one is (0 for
   !> lambda0, which is none).
   type :: choice_t
      character(len=16) :: owner = ''
      character(len=16) :: what = ''
      character(len=16) :: part = ''
      character(len=40) :: range = ''
      integer, allocatable :: entry(:)
   end type choice_t

contains

   !> Take the number of a component or a deformation; 0 where it is missing,
   !> wrong or not there, which has then been reported.
   subroutine take_choice(operands, choice, number)
      type(operands_t), intent(inout) :: operands
      type(choice_t), intent(in) :: choice
      integer, intent(out) :: number

      call operands%positive_integer(choice%part, number)
      if (number <= size(choice%entry)) return
      call operands%diagnostics%error('component-out-of-range', operands%word, &
                                      'the '//trim(choice%owner)//' has no '//trim(choice%part)//' '// &
                                      operands%spelling(), choice%range, &
                                      'name a '//trim(choice%part)//' that the '//trim(choice%owner)//' has')
      operands%fine = .false.
      number = 0
   end subroutine take_choice

   !> The components of a node; those of an orientation are its four Euler
   !> parameters.
   pure function components_of(kind) result(choice)
      integer, intent(in) :: kind
      type(choice_t) :: choice

      choice%owner = 'node'
      choice%what = 'coordinate'
      choice%part = 'component'
      select case (kind)
      case (node_planar_position)
         choice%range = 'a planar position has 1 and 2'
         allocate (choice%entry(2), source=[1, 2])
      case (node_position)
         choice%range = 'a position has 1 to 3'
         allocate (choice%entry(3), source=[1, 2, 3])
      case (node_angle)
         choice%range = 'a planar orientation has 1'
         allocate (choice%entry(1), source=[3])
      case default
         choice%range = 'an orientation has 1 to 4'
         allocate (choice%entry(4), source=[0, 1, 2, 3])
      end select
   end function components_of

   !> The only component of a warping node.
   pure function warping_components() result(choice)
      type(choice_t) :: choice

      choice%owner = 'node'
      choice%what = 'warping'
      choice%part = 'component'
      choice%range = 'a warping node has 1 alone'
      allocate (choice%entry(1), source=[1])
   end function warping_components

   !> The deformations of an element, behind them two of warping where it has them.
   pure function deformations_of(kind, has_warping) result(choice)
      integer, intent(in) :: kind
      logical, intent(in) :: has_warping
      type(choice_t) :: choice
      integer :: i, deformations

      choice%owner = 'element'
      choice%what = 'deformation'
      choice%part = 'deformation'
      deformations = number_of_deformations(kind) + merge(2, 0, has_warping)
      choice%range = trim(element_kinds(kind)%keyword)//' has 1 alone'
      if (deformations > 1) &
         choice%range = trim(element_kinds(kind)%keyword)//' has 1 to '//achar(iachar('0') + deformations)
      if (has_warping) choice%range = beam_with_warping//' has 1 to 8'
      allocate (choice%entry(deformations), source=[(i, i=1, deformations)])
   end function deformations_of
end module flexact_choice
