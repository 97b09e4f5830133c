! SPDX-License-Identifier: BSD-3-Clause
!> Mass, stiffness and geometric stiffness in independent coordinates.
module flexact_elastic_reduced
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_products, only: mass_times, hessian_times, stiffness_in
   use flexact_elastic_response, only: base_t
   use flexact_elastic_rows, only: rows_t
   use flexact_elastic_space, only: space_t, make_space, answer
   use flexact_elastic_state, only: state_t, unit_parameters
   use flexact_elastic_tangent, only: add_hessian, add_mass, component_row
   use flexact_kinds, only: wp
   use flexact_slots, only: axes, node_orientation
   implicit none
   private
   public :: matrices_t, find_matrices

   !> (q, q) each. is_determined: whether rigid and independent ones determine all others.
   type :: matrices_t
      real(wp), allocatable :: mass(:, :), stiffness(:, :), geometric(:, :)
      logical :: is_determined = .false.
   end type matrices_t

contains

   !> independent: 3 node + axis of a coordinate, or -1 - (6 element + deformation), all from 0.
   !> An independent component of an orientation is an Euler parameter.
   subroutine find_matrices(elastic, state, gravity, base, independent, matrices)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3)
      type(base_t), intent(inout) :: base
      integer, intent(in) :: independent(:)
      type(matrices_t), intent(out) :: matrices
      type(rows_t) :: rows
      type(space_t) :: space
      real(wp), allocatable :: c(:), x(:, :)
      real(wp) :: wrong
      integer :: i, q

      q = size(independent)
      call add_rows(elastic, state, base, independent, rows)
      call make_space(elastic, rows, space)
      matrices%is_determined = space%motions == 0
      allocate (x(size(elastic%scale), q), c(rows%count))
      do i = 1, q
         c = 0.0_wp
         c(base%rows%count + i) = 1.0_wp
         call answer(space, elastic, c, x(:, i), wrong)
      end do
      call add_mass(elastic, state%configuration, base%tangent)
      call add_hessian(elastic, state, gravity, base%tangent, on_parameters=.true.)
      allocate (matrices%mass(q, q), matrices%stiffness(q, q), matrices%geometric(q, q))
      do i = 1, q
         matrices%mass(:, i) = matmul(mass_times(elastic, base%tangent, x(:, i)), x)
         matrices%geometric(:, i) = matmul(hessian_times(elastic, base%tangent, x(:, i)), x)
      end do
      call stiffness_in(elastic, base%tangent, x, matrices%stiffness)
   end subroutine find_matrices

   !> The rigid rows, and one for each independent coordinate behind them.
   subroutine add_rows(elastic, state, base, independent, rows)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      type(base_t), intent(in) :: base
      integer, intent(in) :: independent(:)
      type(rows_t), intent(out) :: rows
      integer :: i, r, node, axis, k

      r = base%rows%count
      rows%count = r + size(independent)
      allocate (rows%owner(2, rows%count), rows%entry(12, rows%count), source=0)
      allocate (rows%value(12, rows%count), source=0.0_wp)
      rows%owner(:, :r) = base%rows%owner
      rows%entry(:, :r) = base%rows%entry
      rows%value(:, :r) = base%rows%value
      do i = 1, size(independent)
         r = r + 1
         if (independent(i) < 0) then
            k = (-1 - independent(i))/6 + 1
            rows%entry(:, r) = elastic%entry(:, k)
            rows%value(:, r) = base%tangent%derivative(modulo(-1 - independent(i), 6) + 1, :, k)
            cycle
         end if
         node = independent(i)/axes + 1
         axis = modulo(independent(i), axes) + 1
         rows%entry(1, r) = axes*(node - 1) + axis
         rows%value(1, r) = 1.0_wp
         if (elastic%model%node_kind(node) /= node_orientation) cycle
         rows%entry(:axes, r) = axes*(node - 1) + [1, 2, 3]
         rows%value(:axes, r) = component_row(unit_parameters(state%configuration(:, node)), axis)
      end do
   end subroutine add_rows
end module flexact_elastic_reduced
