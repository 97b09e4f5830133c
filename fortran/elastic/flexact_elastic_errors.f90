! SPDX-License-Identifier: BSD-3-Clause
!> Which errors, each with stresses in proportion, take the lowest frequency to a given one, or the
!> lowest stiffness to zero: the values d nearest to zero at which K - square M + d H(stress) is
!> singular. K with its factor serves all stresses, and what is found for one square the next.
module flexact_elastic_errors
   use flexact_elastic_assembly, only: assemble_hessian, assemble_mass
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, make_operator, shift_operator
   use flexact_elastic_products, only: hessian_times, mass_times, strains, stiffness_times
   use flexact_elastic_response, only: base_t
   use flexact_elastic_space, only: expanded
   use flexact_elastic_state, only: state_t
   use flexact_elastic_tangent, only: add_hessian, add_mass
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_projection, only: project
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise
   use flexact_symmetric_pencil, only: pairs_t, pairs_next_to_zero, end_pairs_of
   implicit none
   private
   public :: errors_t, find_errors

   !> below, above: (squares, stresses) the values nearest to zero on either side, infinite without one.
   type :: errors_t
      real(wp), allocatable :: below(:, :), above(:, :)
      integer :: negative = 0, loose = 0
      logical :: failed = .false.
   end type errors_t

   !> Pairs that are looked for at first, and at most, until there is one on either side.
   integer, parameter :: few = 2, many = 24
   !> Nearer to zero than this part of the nearest error there is none.
   real(wp), parameter :: inside = 1 - 1.0e-6_wp
   !> Of residuals; errors, which are Rayleigh quotients, have the square of it.
   real(wp), parameter :: accuracy = 1.0e-6_wp
   !> On the other side of zero none is looked for beyond so many times the nearest.
   real(wp), parameter :: far = 1.0e4_wp
   !> What is so many times as far as the nearest may be nearer with other meshes.
   real(wp), parameter :: about = 1.2_wp
   !> Values so many times the nearest are rounding.
   real(wp), parameter :: rounding = 1.0e6_wp

contains

   !> The base is that of a state without stress. No errors are found where K - square M has
   !> something negative, or K a motion without stiffness beside a square. lengths (stresses), of
   !> unit errors: only what is about as near as the nearest is looked for, 0: all is.
   subroutine find_errors(elastic, state, gravity, base, square, stress, lengths, errors)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3), square(:), stress(:, :, :), lengths(:)
      type(base_t), target, intent(inout) :: base
      type(errors_t), intent(out) :: errors
      type(operator_t), target :: op(size(square))
      type(sparse_t), target :: hessian
      type(sparse_t) :: mass, whole
      type(state_t) :: stressed
      real(wp) :: nearest(size(square))
      real(wp), allocatable :: start(:)
      integer :: i, k

      allocate (errors%below(size(square), size(stress, 3)), source=-huge(1.0_wp))
      allocate (errors%above(size(square), size(stress, 3)), source=huge(1.0_wp))
      nearest = huge(nearest)
      call make_operator(elastic, base%tangent, base%space, .true., op(1))
      errors%failed = op(1)%failed
      if (errors%failed) return
      if (.not. allocated(base%tangent%mass)) call add_mass(elastic, state%configuration, base%tangent)
      errors%loose = size(op(1)%loose, 2)
      if (any(abs(square) > 0)) then
         call assemble_mass(elastic, base%tangent, base%space%layout, whole)
         call project(base%space%projection, whole, mass)
      end if
      do k = size(square), 1, -1
         if (k > 1) op(k) = op(1)
         if (abs(square(k)) > 0) call shift_operator(base%space, mass, square(k), op(k))
      end do
      errors%failed = any(op%failed)
      errors%negative = maxval(op%negative)
      if (errors%failed .or. errors%negative > 0) return
      stressed = state
      do i = 1, size(stress, 3)
         stressed%stress = stress(:, :, i)
         call add_hessian(elastic, stressed, gravity, base%tangent)
         call assemble_hessian(elastic, base%tangent, base%space%layout, whole)
         call project(base%space%projection, whole, hessian)
         if (allocated(start)) deallocate (start)
         do k = 1, size(square)
            if (nearest(k) < huge(nearest)) then
               if (is_stable_at(base, op(k), hessian, about*nearest(k)/lengths(i))) then
                  if (is_stable_at(base, op(k), hessian, -about*nearest(k)/lengths(i))) cycle
               end if
            end if
            call find_nearest(elastic, base, op(k), hessian, square(k), start, errors%below(k, i), errors%above(k, i), &
                              errors%failed)
            if (errors%failed) return
            if (lengths(i) > 0) nearest(k) = min(nearest(k), lengths(i)*min(-errors%below(k, i), errors%above(k, i)))
         end do
      end do
   end subroutine find_errors

   !> Whether K - square M + d H is definite at an error d, and so everywhere from zero to there.
   logical function is_stable_at(base, op, hessian, d)
      type(base_t), intent(in) :: base
      type(operator_t), intent(in) :: op
      type(sparse_t), intent(in) :: hessian
      real(wp), intent(in) :: d
      type(symmetric_factor_t) :: factor
      type(sparse_t) :: matrix
      type(error_t), allocatable :: error

      is_stable_at = .false.
      if (size(op%loose, 2) > 0) return
      matrix = op%matrix
      matrix%value = op%matrix%value + d*hessian%value
      call factorise(base%space%projection%pattern, matrix, factor, error, op%least)
      if (.not. allocated(error)) is_stable_at = factor%negative == 0
   end function is_stable_at

   !> Values d of (K - square M) v = -d H v on both sides of zero. start: about the sum of their
   !> vectors, if it is known, before; behind that sum.
   subroutine find_nearest(elastic, base, op, hessian, square, start, below, above, failed)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), target, intent(in) :: base
      type(operator_t), target, intent(in) :: op
      type(sparse_t), target, intent(in) :: hessian
      real(wp), intent(in) :: square
      real(wp), allocatable, intent(inout) :: start(:)
      real(wp), intent(out) :: below, above
      logical, intent(out) :: failed
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error
      real(wp) :: value
      integer :: wanted, i

      below = -huge(1.0_wp)
      above = huge(1.0_wp)
      failed = .false.
      if (.not. any(abs(hessian%value) > 0)) return
      call find_quickly(base, op, hessian, start, pairs)
      if (allocated(start) .and. .not. pairs%is_complete) then
         deallocate (start)
         call find_quickly(base, op, hessian, start, pairs)
      end if
      wanted = few
      do while (.not. pairs%is_complete)
         call pairs_next_to_zero(base%space%projection%pattern, op%matrix, op%factor, hessian, wanted, pairs, error, op%least, &
                                 accuracy)
         failed = allocated(error)
         if (failed) return
         if (any(pairs%values > 0) .and. any(pairs%values < 0)) exit
         if (size(pairs%values) < wanted .or. wanted >= many) exit
         wanted = 3*wanted
      end do
      if (size(pairs%values) == 0) return
      start = sum(pairs%vectors, 2)
      do i = 1, size(pairs%values)
         if (abs(pairs%values(i)) > rounding*minval(abs(pairs%values))) cycle
         value = settled(elastic, base, square, pairs%vectors(:, i))
         if (value < 0) below = max(below, value)
         if (value > 0) above = min(above, value)
      end do
   end subroutine find_nearest

   !> The same by the ends of the spectrum of inv(A) B alone. is_complete: none is nearer than the
   !> nearest, and on the other side of zero there is one, too, or none for a long way.
   subroutine find_quickly(base, op, hessian, start, pairs)
      type(base_t), intent(in) :: base
      type(operator_t), intent(in) :: op
      type(sparse_t), intent(in) :: hessian
      real(wp), allocatable, intent(in) :: start(:)
      type(pairs_t), intent(out) :: pairs
      type(error_t), allocatable :: error
      real(wp), allocatable :: values(:), vectors(:, :)
      real(wp) :: nearest
      integer, allocatable :: found(:)
      logical :: is_there
      integer :: i

      call end_pairs_of(base%space%projection%pattern, op%factor, hessian, 1/far, values, vectors, is_there, error, start)
      if (allocated(error) .or. .not. is_there) return
      nearest = values(maxloc(abs(values), 1))
      pairs%is_complete = is_stable_at(base, op, hessian, -inside/nearest)
      if (maxval(-values*sign(1.0_wp, nearest)) <= abs(nearest)/far) &
         pairs%is_complete = pairs%is_complete .and. is_stable_at(base, op, hessian, far/nearest)
      found = pack([(i, i=1, size(values))], abs(values) > abs(nearest)/far)
      pairs%values = -1/values(found)
      pairs%vectors = vectors(:, found)
   end subroutine find_quickly

   !> The error of a vector by the elements' own products, which lose fewer digits.
   function settled(elastic, base, square, y) result(value)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(in) :: square, y(:)
      real(wp) :: value, v(size(elastic%scale)), strain(6, elastic%model%elements)

      v = expanded(base%space, elastic, y)
      strain = strains(elastic, base%tangent, v)
      value = sum(strain*stiffness_times(elastic, strain)) - square*dot_product(v, mass_times(elastic, base%tangent, v))
      value = -value/dot_product(v, hessian_times(elastic, base%tangent, v))
   end function settled
end module flexact_elastic_errors
