! SPDX-License-Identifier: BSD-3-Clause
!> The enumerations and limits of the core by name, for those who read them from
!> outside.
module flexact_names
   use, intrinsic :: iso_c_binding, only: c_signed_char
   use flexact_exchange, only: from_text, to_text
   use flexact_result_exchange, only: fact_names
   use flexact_diagnostics, only: severity_names
   use flexact_elastic_newton, only: step_names
   use flexact_error, only: error_names
   use flexact_element_table, only: frame_names, vector_names, member_names
   use flexact_appearance, only: section_names
   use flexact_keywords, only: keyword_rows
   use flexact_linked, only: linked_names, linked_licences
   use flexact_model, only: class_names
   use flexact_progress, only: stage_names
   use flexact_proof, only: proof_names
   use flexact_result, only: method_names
   use flexact_roles, only: role_names, dual_names
   use flexact_slots, only: node_kind_names
   use flexact_variant_exchange, only: variant_fact_names
   implicit none
   private
   public :: names_t, names_of, give_names

   type :: names_t
      !> The value that the first name stands for.
      integer :: first = 0
      character(len=24), allocatable :: name(:)
   end type names_t

contains

   !> The names of an enumeration; none where there is no such one.
   function names_of(enumeration) result(names)
      character(len=*), intent(in) :: enumeration
      type(names_t) :: names

      select case (enumeration)
      case ('node kinds'); names%name = [node_kind_names]
      case ('classes'); names%name = [class_names]
      case ('frames'); names%name = [frame_names]
      case ('vectors'); names%name = [vector_names]
      case ('members'); names%name = [member_names]
      case ('roles'); names%name = [role_names]
      case ('duals'); names%name = [dual_names]
      case ('methods'); names%name = [method_names]
      case ('proofs'); names%name = [proof_names]
      case ('errors'); names%name = [error_names]
      case ('stages'); names%name = [stage_names]
      case ('facts'); names = names_t(1, [fact_names])
      case ('variant facts'); names = names_t(1, [variant_fact_names])
      case ('step endings'); names%name = [step_names]
      case ('severities'); names = names_t(1, [severity_names])
      case ('keywords'); names%name = keyword_rows()
      case ('cross-sections'); names = names_t(1, [character(len=24) :: section_names])
      case ('linked'); names = names_t(1, [linked_names])
      case ('licences'); names = names_t(1, [linked_licences])
      case default; allocate (names%name(0))
      end select
   end function names_of

   !> The names as bytes, from the first value on; count 0 where there is no such enumeration.
   subroutine give_names(enumeration, names, first, count)
      integer(c_signed_char), intent(in) :: enumeration(:)
      integer(c_signed_char), intent(out) :: names(:, :)
      integer, intent(out) :: first, count
      character(len=:), allocatable :: asked
      type(names_t) :: found
      integer :: i

      call to_text(enumeration, asked)
      found = names_of(asked)
      first = found%first
      count = size(found%name)
      names = 0_c_signed_char
      do i = 1, count
         call from_text(found%name(i), names(:, i))
      end do
   end subroutine give_names
end module flexact_names
