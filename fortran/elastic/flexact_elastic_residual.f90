! SPDX-License-Identifier: BSD-3-Clause
!> Whether forces are in balance, up to what rounding of the coordinates makes of them.
module flexact_elastic_residual
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_products, only: forces
   use flexact_elastic_rows, only: rows_t, keep_multipliers
   use flexact_elastic_space, only: space_t, multipliers_of, reduced, reduced_sizes
   use flexact_elastic_state, only: state_t
   use flexact_elastic_tangent, only: tangent_t
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: left_t, balance

   !> The largest force that is left beyond rounding, relative to the largest of all, and where
   !> most is left.
   type :: left_t
      real(wp) :: relative = 0.0_wp
      integer :: place = 1
      logical :: is_balanced = .true.
   end type left_t

   !> Part of the largest force, and times the effect of rounding, that count as balance.
   real(wp), parameter :: part = 1.0e-12_wp, times = 100.0_wp

contains

   !> Multipliers and reactions that balance loads and the stresses of elastic deformations.
   subroutine balance(elastic, tangent, rows, space, load, state, left)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(rows_t), intent(in) :: rows
      type(space_t), intent(in) :: space
      real(wp), intent(in) :: load(:)
      type(state_t), intent(inout) :: state
      type(left_t), intent(out) :: left
      real(wp), allocatable :: noise(:), most(:)
      real(wp) :: f(size(load)), m(rows%count)
      integer :: i

      m = multipliers_of(space, elastic, load - forces(elastic, tangent, state%stress))
      call keep_multipliers(rows, m, state%stress, state%reaction)
      f = load - forces(elastic, tangent, state%stress) - component_forces(elastic, rows, m)
      do i = 1, size(f)
         if (elastic%is_held(i)) state%reaction(i - axes*((i - 1)/axes), (i + 2)/axes) = -f(i)
      end do
      where (.not. elastic%is_free) f = 0.0_wp
      call sizes_of(elastic, tangent, state, noise, most)
      most = max(most, abs(load))/elastic%scale
      left%place = maxloc(abs(f)/elastic%scale, 1)
      if (maxval(most) > 0) left%relative = maxval(max(abs(f) - times*noise, 0.0_wp)/elastic%scale)/maxval(most)
      ! A rigid body shares what is left with all of its nodes.
      noise = max(part*maxval(most)*elastic%scale, times*noise)
      left%is_balanced = all(abs(reduced(space, elastic, f)) <= reduced_sizes(space, elastic, noise))
   end subroutine balance

   !> Forces of multipliers of single components of orientations.
   pure function component_forces(elastic, rows, m) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      real(wp), intent(in) :: m(:)
      real(wp) :: f(size(elastic%scale))
      integer :: r

      f = 0.0_wp
      do r = 1, rows%count
         if (rows%owner(1, r) == 0) f(rows%entry(:3, r)) = f(rows%entry(:3, r)) + m(r)*rows%value(:3, r)
      end do
   end function component_forces

   !> Of each entry: what rounding of the coordinates of the ends of elements makes of its forces,
   !> and the largest force of one deformation.
   subroutine sizes_of(elastic, tangent, state, noise, most)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(state_t), intent(in) :: state
      real(wp), allocatable, intent(out) :: noise(:), most(:)
      real(wp) :: size_of(12), e(6), d(6, 12)
      integer :: k, i

      allocate (noise(size(elastic%scale)), most(size(elastic%scale)), source=0.0_wp)
      do k = 1, elastic%model%elements
         d = abs(tangent%derivative(:, :, k))
         size_of = 1.0_wp
         do i = 1, 12
            associate (entry => elastic%entry(i, k))
               if (entry == 0) cycle
               if (.not. elastic%is_turn(entry)) size_of(i) = maxval(abs(state%configuration(:axes, (entry + 2)/axes)))
            end associate
         end do
         e = epsilon(1.0_wp)*matmul(abs(elastic%stiffness(:, :, k)), matmul(d, size_of))
         do i = 1, 12
            associate (entry => elastic%entry(i, k))
               if (entry == 0) cycle
               noise(entry) = noise(entry) + dot_product(d(:, i), e + epsilon(1.0_wp)*abs(state%stress(:, k)))
               most(entry) = max(most(entry), maxval(d(:, i)*abs(state%stress(:, k))))
            end associate
         end do
      end do
   end subroutine sizes_of
end module flexact_elastic_residual
