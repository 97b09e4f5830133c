! SPDX-License-Identifier: BSD-3-Clause
!> The statements that give what parts are made of: ESTIFF, EM (EMASS), STRENGTH, EXPANSION, FILLET
!> and XM (MASS). Of two for one thing the last counts.
module flexact_deck_properties
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_deck_model, only: deck_model_t, take_node, take_element
   use flexact_deck_numbers, only: meaning_t, take_numbers
   use flexact_deck_units, only: powers_of_length
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: element_kinds, listed_numbers, member_hinge
   use flexact_keywords, only: keywords, role_property
   use flexact_kinds, only: wp
   use flexact_operands, only: operands_t, operands_of
   use flexact_properties, only: make_properties, node_mass_meant
   use flexact_slots, only: node_orientation, node_angle
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_properties

   !> Where each thing was stated last.
   type :: places_t
      type(span_t), allocatable :: stiffness(:), mass(:), strength(:), expansion(:), fillet(:), node_mass(:)
   end type places_t

contains

   subroutine read_properties(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(places_t) :: stated
      integer :: i

      if (.not. any(statements%role == role_property)) return
      associate (elements => deck%model%elements, nodes => deck%model%nodes)
         allocate (deck%properties, source=make_properties(elements, nodes))
         allocate (stated%stiffness(elements), stated%mass(elements), stated%node_mass(nodes))
         allocate (stated%strength(elements), stated%expansion(elements), stated%fillet(elements))
      end associate
      do i = 1, size(statements)
         if (statements(i)%role == role_property) call read_statement(statements(i), deck, stated)
      end do
   end subroutine read_properties

   subroutine read_statement(statement, deck, stated)
      type(statement_t), intent(in) :: statement
      type(deck_model_t), intent(inout) :: deck
      type(places_t), intent(inout) :: stated
      type(operands_t) :: operands
      integer :: owner

      operands = operands_of(deck%text, deck%diagnostics, statement)
      operands%length_power = deck%length_power
      associate (name => keywords(statement%what)%name, properties => deck%properties, model => deck%model)
         if (name == 'XM' .or. name == 'MASS') then
            call take_node(deck, operands, owner)
            if (owner > 0) call take(operands, mass_of_node(model%node_kind(owner)), properties%node_mass(:, owner), &
                                     stated%node_mass(owner))
            return
         end if
         call take_element(deck, operands, owner)
         if (owner == 0) return
         select case (name)
         case ('ESTIFF')
            call take(operands, stiffness_of(model%element_kind(owner)), properties%stiffness(:, owner), &
                      stated%stiffness(owner))
         case ('STRENGTH')
            call take(operands, strength_of(), properties%strength(:, owner), stated%strength(owner))
         case ('EXPANSION')
            call take(operands, expansion_of(), properties%expansion(:, owner), stated%expansion(owner))
         case ('FILLET')
            call take(operands, fillet_of(), properties%fillet(:, owner), stated%fillet(owner))
         case default
            call take(operands, mass_of(model%element_kind(owner)), properties%mass(:, owner), stated%mass(owner))
         end select
      end associate
   end subroutine read_statement

   !> Take the numbers of a statement that is fine; of an earlier one nothing stays.
   subroutine take(operands, meaning, numbers, stated)
      type(operands_t), intent(inout) :: operands
      type(meaning_t), intent(in) :: meaning
      real(wp), intent(inout) :: numbers(:)
      type(span_t), intent(inout) :: stated
      real(wp) :: value(6)
      integer :: count

      call take_numbers(operands, meaning, value, count, stated)
      if (.not. operands%fine) return
      numbers = ieee_value(1.0_wp, ieee_quiet_nan)
      numbers(:count) = value(:count)
   end subroutine take

   function stiffness_of(kind) result(meaning)
      integer, intent(in) :: kind
      type(meaning_t) :: meaning

      meaning%what = 'a stiffness of '//trim(element_kinds(kind)%keyword)
      meaning%numbers = listed_numbers(element_kinds(kind)%stiffness)
      meaning%lengths = powers_of_length(element_kinds(kind)%stiffness)
      meaning%not_negative = .true.
      select case (trim(element_kinds(kind)%keyword))
      case ('BEAM')
         ! One of warping behind the others is of a beam that is read as one without.
         meaning%passed_over = 1
         meaning%form = 'ESTIFF of a BEAM takes EA, G It, E Iy, E Iz, and the shear E Iy/(G A k), E Iz/(G A k)'
      case ('PLBEAM')
         meaning%form = 'ESTIFF of a PLBEAM takes EA, EI and the shear EI/(G A k)'
      case default
         if (element_kinds(kind)%member == member_hinge) then
            meaning%form = 'ESTIFF of a joint takes one stiffness for each of its deformations, in their order'
         else if (meaning%numbers == 1) then
            meaning%form = 'ESTIFF of a bar takes EA'
         else
            meaning%form = 'it is rigid where it is held; leave ESTIFF out, or write a BEAM or a BEARING'
         end if
      end select
   end function stiffness_of

   function mass_of(kind) result(meaning)
      integer, intent(in) :: kind
      type(meaning_t) :: meaning
      character(len=:), allocatable :: keyword

      meaning%what = 'a mass of '//trim(element_kinds(kind)%keyword)
      meaning%numbers = listed_numbers(element_kinds(kind)%mass)
      meaning%lengths = powers_of_length(element_kinds(kind)%mass)
      ! Jyz may be.
      meaning%not_negative = [.true., .true., .true., .true., .false., .false.]
      keyword = trim(element_kinds(kind)%keyword)
      if (keyword == 'BEAM') meaning%passed_over = 1
      select case (meaning%numbers)
      case (0)
         meaning%form = 'it has no length to be heavy along: give XM to its nodes'
      case (1)
         meaning%form = 'EM of a '//keyword//' takes its mass per length'
      case (2)
         meaning%form = 'EM of a '//keyword//' takes its mass and its moment of inertia per length'
      case default
         meaning%form = 'EM of a '//keyword//' takes its mass and Jxx, Jyy, Jzz, Jyz per length'
      end select
   end function mass_of

   function strength_of() result(meaning)
      type(meaning_t) :: meaning

      meaning%what = 'a strength'
      meaning%numbers = 2
      meaning%lengths = -2
      meaning%not_negative = .true.
      meaning%form = 'STRENGTH takes the stress at which the material yields or breaks, and the one that it bears for good'
   end function strength_of

   function expansion_of() result(meaning)
      type(meaning_t) :: meaning

      meaning%what = 'an expansion'
      meaning%numbers = 1
      meaning%form = 'EXPANSION takes one number, the expansion of the material with temperature'
   end function expansion_of

   function fillet_of() result(meaning)
      type(meaning_t) :: meaning

      meaning%what = 'a radius'
      meaning%numbers = 1
      meaning%lengths = 1
      meaning%not_negative = .true.
      meaning%form = 'FILLET takes one number, the radius of the fillets at both ends'
   end function fillet_of

   function mass_of_node(kind) result(meaning)
      integer, intent(in) :: kind
      type(meaning_t) :: meaning

      meaning%what = 'a mass'
      meaning%numbers = node_mass_meant(kind)
      meaning%not_negative = [.true., .false., .false., .true., .false., .true.]
      meaning%form = 'XM takes one number, a mass or in a plane a moment of inertia'
      if (kind == node_orientation .or. kind == node_angle) meaning%lengths = 2
      if (kind == node_orientation) meaning%form = 'XM of an orientation takes Jxx, Jxy, Jxz, Jyy, Jyz, Jzz'
   end function mass_of_node
end module flexact_deck_properties
