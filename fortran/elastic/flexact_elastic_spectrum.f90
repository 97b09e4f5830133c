! SPDX-License-Identifier: BSD-3-Clause
!> Natural frequencies and buckling multipliers at a state, with their modes.
module flexact_elastic_spectrum
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, make_operator, solved, product
   use flexact_elastic_response, only: base_t
   use flexact_elastic_space, only: reduced, expanded
   use flexact_elastic_tangent, only: add_mass, mass_times, hessian_times
   use flexact_kinds, only: wp
   use flexact_lapack, only: dsyevd
   implicit none
   private
   public :: modes_t, find_frequencies, find_multipliers

   !> Values in ascending order, modes (3 nodes, k); loose: motions without stiffness (K + H for
   !> frequencies, K for multipliers).
   type :: modes_t
      real(wp), allocatable :: value(:), mode(:, :)
      integer :: loose = 0, negative = 0
   end type modes_t

   !> Modes with no more than this part of the mass of the heaviest are without mass.
   real(wp), parameter :: massless = 1.0e-14_wp

contains

   subroutine find_frequencies(elastic, configuration, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :)
      type(base_t), intent(inout) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t) :: op
      real(wp), allocatable :: m(:, :), root(:, :), a(:, :), value(:), v(:, :), left(:, :), all(:)
      integer, allocatable :: order(:)
      integer :: i, n, l, k

      call make_operator(elastic, base%tangent, base%space, op)
      call add_mass(elastic, configuration, base%tangent)
      n = base%space%motions
      l = size(op%loose, 2)
      modes%loose = l
      modes%negative = op%negative
      allocate (m(n, n), a(n, n), value(n))
      do i = 1, n
         m(:, i) = reduced(base%space, mass_times(elastic, base%tangent, base%space%basis(:, i)))
      end do
      call decompose(m, value)
      ! m = U value U'
      k = count(value > massless*max(maxval(value), tiny(1.0_wp)))
      root = m(:, n - k + 1:)
      do i = 1, k
         root(:, i) = root(:, i)*sqrt(value(n - k + i))
      end do
      left = matmul(transpose(root), op%loose)
      call orthonormal_rows(left)
      allocate (v(n, k))
      do i = 1, k
         v(:, i) = solved(op, root(:, i))
      end do
      a = matmul(transpose(root), v)
      a = a - matmul(left, matmul(transpose(left), a))
      a = a - matmul(matmul(a, left), transpose(left))
      deallocate (value)
      allocate (value(k))
      call decompose(a, value)
      v = matmul(v, a)
      order = pack([(i, i=1, k)], abs(value) > 1.0e-13_wp*maxval(abs(value)))
      all = [(0.0_wp, i=1, size(left, 2)), 1/value(order)]
      if (size(left, 2) > 0) v = reshape([op%loose, v(:, order)], [n, size(all)])
      if (size(left, 2) == 0) v = v(:, order)
      call give(elastic, base, op, v, all, most, modes)
   end subroutine find_frequencies

   subroutine give(elastic, base, op, v, values, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: v(:, :), values(:)
      integer, intent(in) :: most
      type(modes_t), intent(inout) :: modes
      logical :: left(size(values))
      real(wp), allocatable :: x(:)
      integer :: i, j, k

      k = min(most, size(values))
      allocate (modes%value(k), modes%mode(size(base%space%basis, 1), k))
      left = .true.
      do i = 1, k
         j = minloc(values, 1, left)
         left(j) = .false.
         x = expanded(base%space, v(:, j))
         modes%mode(:, i) = x/max(maxval(abs(x*elastic%scale)), tiny(1.0_wp))
         modes%value(i) = values(j)
         x = modes%mode(:, i)
         if (abs(values(j)) > 0) modes%value(i) = dot_product(x, product(elastic, base%tangent, op, x)) &
                                                  /dot_product(x, mass_times(elastic, base%tangent, x))
      end do
   end subroutine give

   subroutine find_multipliers(elastic, base, most, modes)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      integer, intent(in) :: most
      type(modes_t), intent(out) :: modes
      type(operator_t) :: op
      real(wp), allocatable :: g(:, :), half(:, :), value(:), v(:, :), x(:)
      integer, allocatable :: order(:)
      integer :: i, n, k

      op%hessian = 0.0_wp
      call make_operator(elastic, base%tangent, base%space, op)
      n = base%space%motions
      modes%loose = size(op%loose, 2)
      modes%negative = op%negative
      allocate (g(n, n), value(n))
      do i = 1, n
         g(:, i) = reduced(base%space, hessian_times(elastic, base%tangent, base%space%basis(:, i)))
      end do
      half = op%vector
      do i = 1, n
         half(:, i) = op%scale*half(:, i)*sqrt(max(op%value(i), 0.0_wp))
      end do
      g = matmul(transpose(half), matmul(g, half))
      call decompose(g, value)
      v = matmul(half, g)
      order = pack([(i, i=1, n)], abs(value) > 1.0e-13_wp*maxval(abs(value)))
      value = -1/value(order)
      v = v(:, order)
      call nearest(value, min(most, size(value)), order)
      k = size(order)
      allocate (modes%value(k), modes%mode(size(base%space%basis, 1), k))
      op%hessian = 0.0_wp
      do i = 1, k
         x = expanded(base%space, v(:, order(i)))
         x = x/max(maxval(abs(x*elastic%scale)), tiny(1.0_wp))
         modes%mode(:, i) = x
         modes%value(i) = -dot_product(x, product(elastic, base%tangent, op, x)) &
                          /dot_product(x, hessian_times(elastic, base%tangent, x))
      end do
   end subroutine find_multipliers

   !> The values of least magnitude, in ascending order.
   pure subroutine nearest(value, many, order)
      real(wp), intent(in) :: value(:)
      integer, intent(in) :: many
      integer, allocatable, intent(out) :: order(:)
      logical :: left(size(value)), taken(size(value))
      integer :: i, j

      taken = .false.
      do i = 1, many
         taken(minloc(abs(value), 1, .not. taken)) = .true.
      end do
      left = taken
      allocate (order(many))
      do i = 1, many
         j = minloc(value, 1, left)
         left(j) = .false.
         order(i) = j
      end do
   end subroutine nearest

   subroutine decompose(a, value)
      real(wp), intent(inout) :: a(:, :)
      real(wp), intent(out) :: value(:)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n, info

      n = size(value)
      if (n == 0) return
      a = (a + transpose(a))/2
      allocate (work(2*n*n + 6*n + 1), iwork(5*n + 3))
      call dsyevd('V', 'L', n, a, n, value, work, size(work), iwork, size(iwork), info)
   end subroutine decompose

   !> Orthonormal columns of the same span; those that are zero are left out.
   pure subroutine orthonormal_rows(a)
      real(wp), allocatable, intent(inout) :: a(:, :)
      real(wp) :: v(size(a, 1)), before
      integer :: i, k, again

      k = 0
      do i = 1, size(a, 2)
         v = a(:, i)
         before = norm2(v)
         do again = 1, 2
            v = v - matmul(a(:, :k), matmul(v, a(:, :k)))
         end do
         if (.not. norm2(v) > 1.0e-9_wp*before) cycle
         k = k + 1
         a(:, k) = v/norm2(v)
      end do
      a = a(:, :k)
   end subroutine orthonormal_rows
end module flexact_elastic_spectrum
