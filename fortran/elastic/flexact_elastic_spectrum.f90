! SPDX-License-Identifier: BSD-3-Clause
!> Natural frequencies and buckling multipliers at a state, with their modes.
module flexact_elastic_spectrum
   use flexact_eigenpairs, only: pencil_eigenpairs
   use flexact_elastic_assembly, only: assemble_hessian, assemble_mass
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, make_operator
   use flexact_elastic_products, only: mass_times, hessian_times, stiffness_in
   use flexact_elastic_response, only: base_t
   use flexact_elastic_space, only: expanded
   use flexact_elastic_tangent, only: add_mass
   use flexact_error, only: error_t, is_kind, error_not_found
   use flexact_kinds, only: wp
   use flexact_projection, only: project
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_pencil, only: pairs_t, lowest_pairs, pairs_next_to_zero
   implicit none
   private
   public :: modes_t, find_frequencies, find_multipliers

   !> Values in ascending order, modes (3 nodes, k) of which the largest entry is 1, with rotations
   !> times a length; loose: motions without stiffness (of K + H for frequencies, of K for
   !> multipliers), negative: negative stiffnesses of the same. is_complete: it is confirmed that
   !> no value is missing between those given.
   type :: modes_t
      real(wp), allocatable :: value(:), mode(:, :)
      integer :: loose = 0, negative = 0
      logical :: failed = .false., is_complete = .true.
   end type modes_t

contains

   subroutine find_frequencies(elastic, configuration, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :)
      type(base_t), intent(inout) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t) :: op
      type(sparse_t) :: whole, mass
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error
      real(wp), allocatable :: v(:, :), value(:)

      call make_operator(elastic, base%tangent, base%space, .true., op)
      call begin(op, base, modes)
      call add_mass(elastic, configuration, base%tangent)
      call assemble_mass(elastic, base%tangent, base%space%layout, whole)
      if (modes%failed .or. .not. any(abs(whole%value) > 0)) return
      call project(base%space%projection, whole, mass)
      call lowest_pairs(base%space%projection%pattern, op%matrix, op%factor, mass, most, pairs, error, op%least)
      ! In the midst of many values that are nearly equal more may be easier.
      if (is_kind(error, error_not_found)) &
         call lowest_pairs(base%space%projection%pattern, op%matrix, op%factor, mass, 2*most, pairs, error, op%least)
      modes%failed = allocated(error)
      if (modes%failed) return
      modes%is_complete = pairs%is_complete
      v = all_expanded(elastic, base, pairs%vectors)
      call settle_frequencies(elastic, base, v, value, modes%failed)
      ! Motions with mass but without stiffness.
      v = reshape([v, all_expanded(elastic, base, pairs%null)], [size(v, 1), size(v, 2) + size(pairs%null, 2)])
      value = [value, spread(0.0_wp, 1, size(pairs%null, 2))]
      call give(elastic, v, value, ascending(value), most, modes)
   end subroutine find_frequencies

   subroutine find_multipliers(elastic, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t) :: op
      type(sparse_t) :: whole, hessian
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error
      real(wp), allocatable :: v(:, :), value(:)
      integer, allocatable :: order(:)

      call make_operator(elastic, base%tangent, base%space, .false., op)
      call begin(op, base, modes)
      call assemble_hessian(elastic, base%tangent, base%space%layout, whole)
      if (modes%failed .or. .not. any(abs(whole%value) > 0)) return
      call project(base%space%projection, whole, hessian)
      call pairs_next_to_zero(base%space%projection%pattern, op%matrix, op%factor, hessian, most, pairs, error, op%least)
      if (is_kind(error, error_not_found)) &
         call pairs_next_to_zero(base%space%projection%pattern, op%matrix, op%factor, hessian, 2*most, pairs, error, op%least)
      modes%failed = allocated(error)
      if (modes%failed) return
      modes%is_complete = pairs%is_complete
      v = all_expanded(elastic, base, pairs%vectors)
      call settle_multipliers(elastic, base, v, value, modes%failed)
      order = ascending(abs(value))
      order = order(:min(most, size(order)))
      call give(elastic, v, value, order(ascending(value(order))), most, modes)
   end subroutine find_multipliers

   !> Without values, to begin with.
   subroutine begin(op, base, modes)
      type(operator_t), intent(in) :: op
      type(base_t), intent(in) :: base
      type(modes_t), intent(inout) :: modes

      allocate (modes%value(0), modes%mode(base%space%layout%columns, 0))
      modes%failed = op%failed
      if (op%failed) return
      modes%loose = size(op%loose, 2)
      modes%negative = op%negative
   end subroutine begin

   function all_expanded(elastic, base, y) result(v)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(in) :: y(:, :)
      real(wp) :: v(size(elastic%scale), size(y, 2))
      integer :: i

      do i = 1, size(y, 2)
         v(:, i) = expanded(base%space, elastic, y(:, i))
      end do
   end function all_expanded

   !> Values of (K + H) v = value M v in the span of some vectors, which are turned to the modes.
   subroutine settle_frequencies(elastic, base, v, value, failed)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(inout) :: v(:, :)
      real(wp), allocatable, intent(out) :: value(:)
      logical, intent(out) :: failed
      real(wp) :: k(size(v, 2), size(v, 2)), m(size(v, 2), size(v, 2))
      type(error_t), allocatable :: error
      integer :: i

      allocate (value(size(v, 2)))
      call stiffness_in(elastic, base%tangent, v, k)
      do i = 1, size(v, 2)
         k(:, i) = k(:, i) + matmul(hessian_times(elastic, base%tangent, v(:, i)), v)
         m(:, i) = matmul(mass_times(elastic, base%tangent, v(:, i)), v)
      end do
      call pencil_eigenpairs(k, m, value, error)
      failed = allocated(error)
      v = matmul(v, k)
   end subroutine settle_frequencies

   !> The same of K v = -value H v.
   subroutine settle_multipliers(elastic, base, v, value, failed)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(inout) :: v(:, :)
      real(wp), allocatable, intent(out) :: value(:)
      logical, intent(out) :: failed
      real(wp) :: k(size(v, 2), size(v, 2)), h(size(v, 2), size(v, 2))
      type(error_t), allocatable :: error
      integer :: i

      allocate (value(size(v, 2)))
      call stiffness_in(elastic, base%tangent, v, k)
      do i = 1, size(v, 2)
         h(:, i) = matmul(hessian_times(elastic, base%tangent, v(:, i)), v)
      end do
      call pencil_eigenpairs(h, k, value, error)
      failed = allocated(error)
      value = -1/value
      v = matmul(v, h)
   end subroutine settle_multipliers

   subroutine give(elastic, v, value, order, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: v(:, :), value(:)
      integer, intent(in) :: order(:), most
      type(modes_t), intent(inout) :: modes
      integer :: i, k

      k = min(most, size(order))
      modes%value = value(order(:k))
      modes%mode = v(:, order(:k))
      do i = 1, k
         modes%mode(:, i) = modes%mode(:, i)/max(maxval(abs(modes%mode(:, i)*elastic%scale)), tiny(1.0_wp))
      end do
   end subroutine give
end module flexact_elastic_spectrum
