! SPDX-License-Identifier: BSD-3-Clause
!> Products with a mechanism's derivatives, stiffness and mass, formed element by element: so a
!> stiff elongation beside a soft bending costs half of the digits that it costs in an assembled
!> matrix.
module flexact_elastic_products
   use flexact_elastic_model, only: elastic_model_t, gathered, scatter
   use flexact_elastic_tangent, only: tangent_t
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: strains, forces, stiffness_times, hessian_times, mass_times, stiffness_in

contains

   !> D v for every deformation.
   pure function strains(elastic, tangent, v) result(e)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: v(:)
      real(wp) :: e(6, elastic%model%elements)
      real(wp) :: d(6, 12), part(12)
      integer :: k

      do k = 1, elastic%model%elements
         d = tangent%derivative(:, :, k)
         part = gathered(elastic%entry(:, k), v)
         e(:, k) = matmul(d, part)
      end do
   end function strains

   !> D' sigma.
   pure function forces(elastic, tangent, stress) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: stress(:, :)
      real(wp) :: f(axes*elastic%model%nodes)
      real(wp) :: d(6, 12), part(6)
      integer :: k

      f = 0.0_wp
      do k = 1, elastic%model%elements
         d = tangent%derivative(:, :, k)
         part = stress(:, k)
         call scatter(elastic%entry(:, k), matmul(part, d), f)
      end do
   end function forces

   !> S e.
   pure function stiffness_times(elastic, e) result(stress)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: e(:, :)
      real(wp) :: stress(6, elastic%model%elements)
      real(wp) :: s(6, 6), part(6)
      integer :: k

      do k = 1, elastic%model%elements
         s = elastic%stiffness(:, :, k)
         part = e(:, k)
         stress(:, k) = matmul(s, part)
      end do
   end function stiffness_times

   !> H v.
   pure function hessian_times(elastic, tangent, v) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: v(:)
      real(wp) :: f(axes*elastic%model%nodes)
      real(wp) :: block(12, 12), part(12)
      integer :: k, node

      do node = 1, elastic%model%nodes
         f(axes*node - 2:axes*node) = matmul(tangent%node_hessian(:, :, node), v(axes*node - 2:axes*node))
      end do
      do k = 1, elastic%model%elements
         block = tangent%hessian(:, :, k)
         part = gathered(elastic%entry(:, k), v)
         call scatter(elastic%entry(:, k), matmul(block, part), f)
      end do
   end function hessian_times

   !> M v.
   pure function mass_times(elastic, tangent, v) result(f)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: v(:)
      real(wp) :: f(axes*elastic%model%nodes)
      real(wp) :: block(12, 12), part(12)
      integer :: k, node

      do node = 1, elastic%model%nodes
         f(axes*node - 2:axes*node) = matmul(tangent%node_mass(:, :, node), v(axes*node - 2:axes*node))
      end do
      do k = 1, elastic%model%elements
         block = tangent%mass(:, :, k)
         part = gathered(elastic%entry(:, k), v)
         call scatter(elastic%entry(:, k), matmul(block, part), f)
      end do
   end function mass_times

   !> V' (D'S D) V, from strains.
   subroutine stiffness_in(elastic, tangent, v, k)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: v(:, :)
      real(wp), intent(out) :: k(:, :)
      real(wp), allocatable :: e(:, :), s(:, :), strain(:, :)
      integer :: i, n

      n = 6*elastic%model%elements
      allocate (e(n, size(v, 2)), s(n, size(v, 2)))
      do i = 1, size(v, 2)
         strain = strains(elastic, tangent, v(:, i))
         e(:, i) = reshape(strain, [n])
         s(:, i) = reshape(stiffness_times(elastic, strain), [n])
      end do
      k = matmul(transpose(e), s)
   end subroutine stiffness_in
end module flexact_elastic_products
