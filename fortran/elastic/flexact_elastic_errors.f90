! SPDX-License-Identifier: BSD-3-Clause
!> Which errors, each with stresses in proportion, take the lowest frequency to a given one, or the
!> lowest stiffness to zero: the values d nearest to zero at which K - square M + d H(stress) is
!> singular. K with its factor serves all stresses.
module flexact_elastic_errors
   use flexact_block_lanczos, only: self_adjoint_t, largest_pairs
   use flexact_elastic_assembly, only: assemble_hessian, assemble_mass
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, make_operator, shift_operator
   use flexact_elastic_projection, only: project
   use flexact_elastic_response, only: base_t
   use flexact_elastic_space, only: expanded
   use flexact_elastic_state, only: state_t
   use flexact_elastic_tangent, only: add_hessian, add_mass, hessian_times, mass_times, strains, stiffness_times
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: solve, symmetric_times
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: errors_t, find_errors

   !> below, above: (stresses) the values nearest to zero on either side, infinite without one.
   type :: errors_t
      real(wp), allocatable :: below(:), above(:)
      integer :: negative = 0, loose = 0
      logical :: failed = .false.
   end type errors_t

   !> inv(A) B in the inner product of A, which is definite.
   type, extends(self_adjoint_t) :: definite_t
      type(symmetric_pattern_t), pointer :: pattern => null()
      type(operator_t), pointer :: a => null()
      type(sparse_t), pointer :: b => null()
   contains
      procedure :: apply
      procedure :: weigh
   end type definite_t

   !> Pairs that are looked for at first, and at most, until there is one on either side.
   integer, parameter :: few = 2, many = 24, block = 2
   !> Of residuals; errors, which are Rayleigh quotients, have the square of it.
   real(wp), parameter :: accuracy = 1.0e-4_wp
   !> Values so many times the nearest are rounding.
   real(wp), parameter :: rounding = 1.0e6_wp

contains

   subroutine apply(self, x, y)
      class(definite_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%b, x, y)
      call solve(self%pattern, self%a%factor, y)
   end subroutine apply

   subroutine weigh(self, x, y)
      class(definite_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%a%matrix, x, y)
   end subroutine weigh

   !> The base is that of a state without stress. No errors are found where K - square M has
   !> something negative, or a motion without stiffness.
   subroutine find_errors(elastic, state, gravity, base, square, stress, errors)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3), square, stress(:, :, :)
      type(base_t), target, intent(inout) :: base
      type(errors_t), intent(out) :: errors
      type(operator_t), target :: op
      type(sparse_t), target :: hessian
      type(sparse_t) :: mass, whole
      type(state_t) :: stressed
      integer :: i

      allocate (errors%below(size(stress, 3)), errors%above(size(stress, 3)))
      call make_operator(elastic, base%tangent, base%space, .true., op)
      errors%failed = op%failed
      if (op%failed) return
      if (.not. allocated(base%tangent%mass)) call add_mass(elastic, state%configuration, base%tangent)
      if (abs(square) > 0) then
         call assemble_mass(elastic, base%tangent, base%space%layout, whole)
         call project(base%space%projection, whole, mass)
         call shift_operator(base%space, mass, square, op)
      end if
      errors%failed = op%failed
      errors%negative = op%negative
      if (op%failed) return
      errors%loose = size(op%loose, 2)
      if (errors%negative + errors%loose > 0) return
      stressed = state
      do i = 1, size(stress, 3)
         stressed%stress = stress(:, :, i)
         call add_hessian(elastic, stressed, gravity, base%tangent)
         call assemble_hessian(elastic, base%tangent, base%space%layout, whole)
         call project(base%space%projection, whole, hessian)
         call find_nearest(elastic, base, op, hessian, square, errors%below(i), errors%above(i), errors%failed)
         if (errors%failed) return
      end do
   end subroutine find_errors

   !> Eigenvalues v of inv(K - square M) H of largest magnitude on both sides; errors are -1/v.
   subroutine find_nearest(elastic, base, op, hessian, square, below, above, failed)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), target, intent(in) :: base
      type(operator_t), target, intent(in) :: op
      type(sparse_t), target, intent(in) :: hessian
      real(wp), intent(in) :: square
      real(wp), intent(out) :: below, above
      logical, intent(out) :: failed
      type(definite_t) :: pencil
      type(error_t), allocatable :: error
      real(wp), allocatable :: value(:), v(:, :)
      integer :: wanted, i

      below = -huge(1.0_wp)
      above = huge(1.0_wp)
      failed = .false.
      if (.not. any(abs(hessian%value) > 0)) return
      pencil%pattern => base%space%projection%pattern
      pencil%a => op
      pencil%b => hessian
      wanted = few
      do
         call largest_pairs(pencil, base%space%motions, wanted, value, v, error, block, accuracy)
         failed = allocated(error)
         if (failed) return
         if (any(value > 0) .and. any(value < 0)) exit
         if (size(value) < wanted .or. wanted >= many) exit
         wanted = 3*wanted
      end do
      if (size(value) == 0) return
      do i = size(value), 1, -1
         if (rounding*abs(value(i)) < abs(value(1))) cycle
         if (value(i) > 0) below = settled(elastic, base, square, v(:, i))
         if (value(i) < 0) above = settled(elastic, base, square, v(:, i))
      end do
   end subroutine find_nearest

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
