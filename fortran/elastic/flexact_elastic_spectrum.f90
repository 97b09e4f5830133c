! SPDX-License-Identifier: BSD-3-Clause
!> Natural frequencies and buckling multipliers at a state, with their modes.
module flexact_elastic_spectrum
   use flexact_block_lanczos, only: largest_pairs
   use flexact_eigenpairs, only: pencil_eigenpairs
   use flexact_elastic_assembly, only: assemble_hessian, assemble_mass
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, make_operator
   use flexact_elastic_pencil, only: pencil_t, make_pencil
   use flexact_elastic_projection, only: project
   use flexact_elastic_response, only: base_t
   use flexact_elastic_space, only: expanded
   use flexact_elastic_tangent, only: add_mass, mass_times, hessian_times, strains, stiffness_times
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: modes_t, find_frequencies, find_multipliers

   !> Values in ascending order, modes (3 nodes, k) of which the largest entry is 1, with rotations
   !> times a length; loose: motions without stiffness (of K + H for frequencies, of K for
   !> multipliers), negative: negative stiffnesses of the same.
   type :: modes_t
      real(wp), allocatable :: value(:), mode(:, :)
      integer :: loose = 0, negative = 0
      logical :: failed = .false.
   end type modes_t

contains

   subroutine find_frequencies(elastic, configuration, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :)
      type(base_t), target, intent(inout) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t), target :: op
      type(sparse_t), target :: mass
      type(sparse_t) :: whole
      type(pencil_t) :: pencil
      real(wp), allocatable :: v(:, :), value(:)

      call make_operator(elastic, base%tangent, base%space, .true., op)
      modes%failed = op%failed
      if (op%failed) return
      modes%loose = size(op%loose, 2)
      modes%negative = op%negative
      call add_mass(elastic, configuration, base%tangent)
      call assemble_mass(elastic, base%tangent, base%space%layout, whole)
      call project(base%space%projection, whole, mass)
      call make_pencil(base%space, op, mass, mass, pencil)
      call find_pairs(pencil, most, op%negative, v, modes%failed)
      if (modes%failed) return
      v = all_expanded(elastic, base, v)
      call settle_frequencies(elastic, base, v, value, modes%failed)
      ! Motions with mass but without stiffness.
      v = reshape([v, all_expanded(elastic, base, pencil%touched)], [size(v, 1), size(v, 2) + size(pencil%touched, 2)])
      value = [value, spread(0.0_wp, 1, size(pencil%touched, 2))]
      call give(elastic, v, value, ascending(value), most, modes)
   end subroutine find_frequencies

   subroutine find_multipliers(elastic, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), target, intent(in) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t), target :: op
      type(sparse_t), target :: hessian
      type(sparse_t) :: whole
      type(pencil_t) :: pencil
      real(wp), allocatable :: v(:, :), value(:)
      integer, allocatable :: order(:)

      call make_operator(elastic, base%tangent, base%space, .false., op)
      modes%failed = op%failed
      if (op%failed) return
      modes%loose = size(op%loose, 2)
      modes%negative = op%negative
      call assemble_hessian(elastic, base%tangent, base%space%layout, whole)
      call project(base%space%projection, whole, hessian)
      call make_pencil(base%space, op, hessian, op%matrix, pencil)
      call find_pairs(pencil, most, 0, v, modes%failed)
      if (modes%failed) return
      v = all_expanded(elastic, base, v)
      call settle_multipliers(elastic, base, v, value, modes%failed)
      order = ascending(abs(value))
      order = order(:min(most, size(order)))
      call give(elastic, v, value, order(ascending(value(order))), most, modes)
   end subroutine find_multipliers

   !> The pairs of largest magnitude; with negative ones among them as far as they are found.
   subroutine find_pairs(pencil, most, negative, v, failed)
      type(pencil_t), intent(in) :: pencil
      integer, intent(in) :: most, negative
      real(wp), allocatable, intent(out) :: v(:, :)
      logical, intent(out) :: failed
      real(wp), allocatable :: value(:)
      type(error_t), allocatable :: error
      integer :: wanted

      wanted = most + negative
      failed = .false.
      if (.not. any(abs(pencil%b%value) > 0)) then
         allocate (v(pencil%space%motions, 0))
         return
      end if
      do
         call largest_pairs(pencil, pencil%space%motions, wanted, value, v, error)
         failed = allocated(error)
         if (failed .or. count(value < 0) >= negative .or. size(value) < wanted) return
         if (wanted > 4*(most + negative)) return
         wanted = 2*wanted
      end do
   end subroutine find_pairs

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

   !> V' (D'S D) V, from strains.
   subroutine stiffness_in(elastic, base, v, k)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(in) :: v(:, :)
      real(wp), intent(out) :: k(:, :)
      real(wp), allocatable :: e(:, :), s(:, :), strain(:, :)
      integer :: i, n

      n = 6*elastic%model%elements
      allocate (e(n, size(v, 2)), s(n, size(v, 2)))
      do i = 1, size(v, 2)
         strain = strains(elastic, base%tangent, v(:, i))
         e(:, i) = reshape(strain, [n])
         s(:, i) = reshape(stiffness_times(elastic, strain), [n])
      end do
      k = matmul(transpose(e), s)
   end subroutine stiffness_in

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
      call stiffness_in(elastic, base, v, k)
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
      call stiffness_in(elastic, base, v, k)
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
