! SPDX-License-Identifier: BSD-3-Clause
!> The rows of what is rigid: deformations held at their misfit, and single components of
!> orientations held at their targets.
module flexact_elastic_rows
   use flexact_elastic_model, only: elastic_model_t, is_rigid
   use flexact_elastic_state, only: unit_parameters
   use flexact_elastic_tangent, only: tangent_t, component_row
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: rows_t, make_rows, rows_times, errors_of, values_at_rows, keep_multipliers

   !> Row r has value(:, r) at entry(:, r) of a vector, 0 where there is none. owner: element
   !> and deformation, or 0 and the entry of the component that is held.
   type :: rows_t
      integer :: count = 0
      integer, allocatable :: owner(:, :), entry(:, :)
      real(wp), allocatable :: value(:, :)
   end type rows_t

contains

   subroutine make_rows(elastic, configuration, tangent, rows)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :)
      type(tangent_t), intent(in) :: tangent
      type(rows_t), intent(inout) :: rows
      integer :: r, k, i

      if (.not. allocated(rows%owner)) call number_rows(elastic, rows)
      do r = 1, rows%count
         k = rows%owner(1, r)
         i = rows%owner(2, r)
         if (k > 0) then
            rows%value(:, r) = tangent%derivative(i, :, k)
         else
            rows%value(:3, r) = component_row(unit_parameters(configuration(:, (i + 2)/axes)), i - axes*((i - 1)/axes))
         end if
      end do
   end subroutine make_rows

   pure subroutine number_rows(elastic, rows)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(inout) :: rows
      integer :: k, i, first

      rows%count = count(elastic%part == is_rigid) + count(elastic%is_component)
      allocate (rows%owner(2, rows%count), rows%entry(12, rows%count), rows%value(12, rows%count))
      rows%entry = 0
      rows%value = 0.0_wp
      rows%count = 0
      do k = 1, elastic%model%elements
         do i = 1, size(elastic%part, 1)
            if (elastic%part(i, k) /= is_rigid) cycle
            rows%count = rows%count + 1
            rows%owner(:, rows%count) = [k, i]
            rows%entry(:, rows%count) = elastic%entry(:, k)
         end do
      end do
      do i = 1, size(elastic%is_component)
         if (.not. elastic%is_component(i)) cycle
         rows%count = rows%count + 1
         rows%owner(:, rows%count) = [0, i]
         first = axes*((i - 1)/axes)
         rows%entry(:3, rows%count) = [first + 1, first + 2, first + 3]
      end do
   end subroutine number_rows

   !> J v.
   pure function rows_times(rows, v) result(y)
      type(rows_t), intent(in) :: rows
      real(wp), intent(in) :: v(:)
      real(wp) :: y(rows%count)
      integer :: r, i

      y = 0.0_wp
      do r = 1, rows%count
         do i = 1, size(rows%entry, 1)
            if (rows%entry(i, r) > 0) y(r) = y(r) + rows%value(i, r)*v(rows%entry(i, r))
         end do
      end do
   end function rows_times

   !> By how much what is rigid is not where it has to be.
   pure function errors_of(rows, tangent, configuration, misfit, target) result(c)
      type(rows_t), intent(in) :: rows
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: configuration(:, :), misfit(:, :), target(:, :)
      real(wp) :: c(rows%count)
      real(wp) :: euler(4)
      integer :: r, node, axis

      do r = 1, rows%count
         associate (k => rows%owner(1, r), i => rows%owner(2, r))
            if (k > 0) then
               c(r) = tangent%deformation(i, k) - misfit(i, k)
            else
               node = (i + 2)/axes
               axis = i - axes*(node - 1)
               euler = unit_parameters(configuration(:, node))
               c(r) = euler(1 + axis) - target(1 + axis, node)
            end if
         end associate
      end do
   end function errors_of

   !> What increments of misfits (6, elements) and of supports (3 nodes) ask of the rows.
   pure function values_at_rows(rows, misfit, shift) result(c)
      type(rows_t), intent(in) :: rows
      real(wp), intent(in) :: misfit(:, :), shift(:)
      real(wp) :: c(rows%count)
      integer :: r

      do r = 1, rows%count
         if (rows%owner(1, r) > 0) then
            c(r) = misfit(rows%owner(2, r), rows%owner(1, r))
         else
            c(r) = shift(rows%owner(2, r))/2
         end if
      end do
   end function values_at_rows

   !> Multipliers as stresses of rigid deformations, and as reactions of single components.
   pure subroutine keep_multipliers(rows, multiplier, stress, reaction)
      type(rows_t), intent(in) :: rows
      real(wp), intent(in) :: multiplier(:)
      real(wp), intent(inout) :: stress(:, :), reaction(:, :)
      integer :: r, node

      do r = 1, rows%count
         associate (k => rows%owner(1, r), i => rows%owner(2, r))
            if (k > 0) then
               stress(i, k) = multiplier(r)
            else
               node = (i + 2)/axes
               reaction(i - axes*(node - 1), node) = -multiplier(r)/2
            end if
         end associate
      end do
   end subroutine keep_multipliers
end module flexact_elastic_rows
