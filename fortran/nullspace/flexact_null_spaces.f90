! SPDX-License-Identifier: BSD-3-Clause
!> Bases of both null spaces of a connected matrix, from its low end.
module flexact_null_spaces
   use flexact_complete_pivoting, only: eliminate
   use flexact_error, only: error_t, is_kind, error_not_found
   use flexact_kinds, only: wp
   use flexact_left_null_space, only: left_null_space
   use flexact_local_vectors, only: find_scattered_vectors
   use flexact_low_end, only: low_end_t
   use flexact_pin_search, only: low_end
   use flexact_pinned, only: pinned_t
   use flexact_sparse, only: operator_t
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   implicit none
   private
   public :: find_null_spaces

   !> Left vectors up to this number, or up to this work of turning them into a basis,
   !> some 50 ms, are all given; of more the first, local ones.
   integer, parameter :: most_left = 64
   real(wp), parameter :: most_work = 5.0e7_wp
   integer, parameter :: first_left = 6

contains

   !> Right vectors (columns, k), beside the local ones of the low end, and left ones
   !> (rows, k), or of very many some that are local, in `many`.
   subroutine find_null_spaces(a, pinned, low, right, left, many, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(inout) :: low
      real(wp), allocatable, intent(out) :: right(:, :), left(:, :)
      type(sparse_basis_t), intent(out) :: many
      type(error_t), allocatable, intent(out) :: error
      integer :: k

      right = low%vectors(:, pack([(k, k=1, size(low%values))], low%values <= low%decision%tolerance))
      call new_sparse_basis(many)
      call find_left(a, pinned, low, left, many, error)
      if (allocated(error)) return
      call eliminate(right)
      call eliminate(left)
   end subroutine find_null_spaces

   subroutine find_left(a, pinned, low, left, many, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(inout) :: low
      real(wp), allocatable, intent(out) :: left(:, :)
      type(sparse_basis_t), intent(inout) :: many
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: projected(:, :)
      logical, dimension(size(low%values)) :: is_zero, is_held
      integer, allocatable :: known(:), images(:)
      logical :: is_few
      integer :: k, wanted, rows

      rows = a%by_column%rows
      is_zero = low%values <= low%decision%tolerance
      is_held = [(k <= low%pins .and. low%values(k) <= low_end*pinned%least, k=1, size(is_zero))]
      known = pack([(k, k=1, size(is_zero))],.not. is_zero)
      ! Of what counts as zero though no pin holds it, the images are the left vectors.
      images = pack([(k, k=1, size(is_zero))], is_zero .and. .not. is_held)
      wanted = rows - a%by_column%columns + low%local%vectors + count(is_held .and. is_zero)
      is_few = wanted <= most_left .or. rows*real(wanted, wp)**2 <= most_work
      if (.not. is_few .and. size(images) == 0) then
         call find_scattered_vectors(operator_t(a%by_row, a%by_column), first_left, many)
         if (many%vectors > 0) then
            allocate (left(rows, 0))
            return
         end if
      end if
      call left_null_space(a, pinned, low%images(:, known), merge(wanted, first_left, is_few), projected, error)
      if (is_kind(error, error_not_found)) then
         low%confirmed = .false.
         projected = projected(:, :0)
         deallocate (error)
      end if
      if (allocated(error)) return
      allocate (left(rows, size(projected, 2) + size(images)))
      left(:, :size(projected, 2)) = projected
      left(:, size(projected, 2) + 1:) = low%images(:, images)
   end subroutine find_left
end module flexact_null_spaces
