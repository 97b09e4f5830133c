! SPDX-License-Identifier: BSD-3-Clause
!> Stiffness (and mass times a shift) of the motions that rigid rows leave, ready to solve with.
!> Motions without stiffness are found, and left out of what is solved for.
module flexact_elastic_operator
   use flexact_elastic_model, only: elastic_model_t, gathered
   use flexact_elastic_space, only: space_t
   use flexact_elastic_tangent, only: tangent_t, strains, stiffness_times, forces, hessian_times, mass_times
   use flexact_kinds, only: wp
   use flexact_lapack, only: dsyevd
   implicit none
   private
   public :: operator_t, make_operator, solved, product

   !> Which parts are there: (D'S D)*stiffness + H*hessian - M*shift.
   type :: operator_t
      real(wp) :: stiffness = 1.0_wp, hessian = 1.0_wp, shift = 0.0_wp
      integer :: negative = 0
      !> (motions, loose) orthonormal.
      real(wp), allocatable :: loose(:, :)
      real(wp), allocatable :: vector(:, :), value(:), scale(:)
   end type operator_t

   real(wp), parameter :: nearly_loose = 1.0e-9_wp, no_stiffness = 1.0e-19_wp, no_hessian = 1.0e-11_wp

contains

   !> The product with a vector of the mechanism.
   function product(elastic, tangent, op, v) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: v(:)
      real(wp) :: f(size(v))

      f = 0.0_wp
      if (op%stiffness > 0) f = forces(elastic, tangent, stiffness_times(elastic, strains(elastic, tangent, v)))
      if (op%hessian > 0) f = f + hessian_times(elastic, tangent, v)
      if (abs(op%shift) > 0) f = f - op%shift*mass_times(elastic, tangent, v)
   end function product

   subroutine make_operator(elastic, tangent, space, op)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(space_t), intent(in) :: space
      type(operator_t), intent(inout) :: op
      real(wp), allocatable :: full(:, :), work(:)
      integer, allocatable :: iwork(:)
      logical, allocatable :: is_loose(:)
      integer :: i, n, info

      n = space%motions
      allocate (full(size(space%basis, 1), n))
      do i = 1, n
         full(:, i) = product(elastic, tangent, op, space%basis(:, i))
      end do
      op%vector = matmul(transpose(space%basis), full)
      op%vector = (op%vector + transpose(op%vector))/2
      op%scale = [(abs(op%vector(i, i)), i=1, n)]
      op%scale = 1/sqrt(max(op%scale, 1.0e-12_wp*maxval(op%scale), tiny(1.0_wp)))
      do i = 1, n
         op%vector(:, i) = op%vector(:, i)*op%scale*op%scale(i)
      end do
      if (allocated(op%value)) deallocate (op%value)
      allocate (op%value(n), work(2*n*n + 6*n + 1), iwork(5*n + 3), is_loose(n))
      if (n > 0) call dsyevd('V', 'L', n, op%vector, n, op%value, work, size(work), iwork, size(iwork), info)
      is_loose = .false.
      do i = 1, n
         if (abs(op%value(i)) < nearly_loose) &
            is_loose(i) = has_no_stiffness(elastic, tangent, op, matmul(space%basis, op%scale*op%vector(:, i)))
      end do
      op%negative = count(op%value < 0 .and. .not. is_loose)
      op%loose = op%vector(:, pack([(i, i=1, n)], is_loose))
      do i = 1, size(op%loose, 2)
         op%loose(:, i) = op%scale*op%loose(:, i)
      end do
      where (is_loose)
         op%value = 0.0_wp
      elsewhere
         op%value = 1/op%value
      end where
   end subroutine make_operator

   !> Whether a motion meets no more than rounding of each part.
   logical function has_no_stiffness(elastic, tangent, op, v) result(none)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: v(:)
      real(wp) :: e(6), part(12), a, b, c, most(3)
      integer :: k, i

      most = 0.0_wp
      a = 0.0_wp
      b = 0.0_wp
      do k = 1, elastic%model%elements
         part = gathered(elastic%entry(:, k), v)
         e = matmul(tangent%derivative(:, :, k), part)
         a = a + dot_product(e, matmul(elastic%stiffness(:, :, k), e))
         e = matmul(abs(tangent%derivative(:, :, k)), abs(part))
         do i = 1, 6
            most(1) = most(1) + elastic%stiffness(i, i, k)*e(i)**2
         end do
         b = b + dot_product(part, matmul(tangent%hessian(:, :, k), part))
         most(2) = most(2) + dot_product(abs(part), matmul(abs(tangent%hessian(:, :, k)), abs(part)))
      end do
      c = dot_product(v, mass_shift(elastic, tangent, op, v))
      none = abs(c) <= 0
      if (op%stiffness > 0) none = none .and. a <= no_stiffness*most(1)
      if (op%hessian > 0) none = none .and. abs(b) <= no_hessian*most(2)
   end function has_no_stiffness

   function mass_shift(elastic, tangent, op, v) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: v(:)
      real(wp) :: f(size(v))

      f = 0.0_wp
      if (abs(op%shift) > 0) f = op%shift*mass_times(elastic, tangent, v)
   end function mass_shift

   !> The motion that answers to a force; nothing along motions without stiffness.
   pure function solved(op, r) result(y)
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: r(:)
      real(wp) :: y(size(r))

      y = op%scale*matmul(op%vector, op%value*matmul(op%scale*r, op%vector))
   end function solved
end module flexact_elastic_operator
