! SPDX-License-Identifier: BSD-3-Clause
!> The stiffness of the motions that rigid rows leave, ready to solve with. Motions without
!> stiffness are found, and left out of what is solved for.
module flexact_elastic_operator
   use flexact_elastic_assembly, only: assemble_stiffness
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_space, only: space_t
   use flexact_elastic_tangent, only: tangent_t
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_projection, only: project
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise, solve, null_vectors
   implicit none
   private
   public :: operator_t, make_operator, shift_operator, solved

   type :: operator_t
      integer :: negative = 0
      !> Lower triangle of Z'(K + H)Z.
      type(sparse_t) :: matrix
      type(symmetric_factor_t) :: factor
      !> (motions, loose) orthonormal.
      real(wp), allocatable :: loose(:, :)
      !> What the terms of each diagonal entry sum up to in magnitude.
      real(wp), allocatable :: least(:)
      logical :: failed = .false.
      type(sparse_t), private :: whole
   end type operator_t

contains

   subroutine make_operator(elastic, tangent, space, with_hessian, op)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(space_t), intent(in) :: space
      logical, intent(in) :: with_hessian
      type(operator_t), intent(inout) :: op
      type(error_t), allocatable :: error
      real(wp), allocatable :: least(:)
      integer :: j, p

      op%failed = .true.
      if (allocated(op%loose)) deallocate (op%loose)
      call assemble_stiffness(elastic, tangent, space%layout, with_hessian, op%whole, least)
      associate (z => space%projection%basis)
         op%least = spread(0.0_wp, 1, z%columns)
         do j = 1, z%columns
            do p = z%start(j), z%start(j + 1) - 1
               op%least(j) = op%least(j) + z%value(p)**2*least(z%place(p))
            end do
         end do
      end associate
      if (.not. all(op%least <= huge(1.0_wp))) return
      call project(space%projection, op%whole, op%matrix)
      call factorise(space%projection%pattern, op%matrix, op%factor, error, op%least)
      if (allocated(error)) return
      call null_vectors(space%projection%pattern, op%factor, op%loose, error)
      if (allocated(error)) return
      op%negative = op%factor%negative
      op%failed = .false.
   end subroutine make_operator

   !> Z'(K + H - square M)Z, of the operator that was made.
   subroutine shift_operator(space, mass, square, op)
      type(space_t), intent(in) :: space
      type(sparse_t), intent(in) :: mass
      real(wp), intent(in) :: square
      type(operator_t), intent(inout) :: op
      type(error_t), allocatable :: error

      op%matrix%value = op%matrix%value - square*mass%value
      call factorise(space%projection%pattern, op%matrix, op%factor, error, op%least)
      op%failed = allocated(error)
      if (op%failed) return
      if (allocated(op%loose)) deallocate (op%loose)
      call null_vectors(space%projection%pattern, op%factor, op%loose, error)
      op%failed = allocated(error)
      op%negative = op%factor%negative
   end subroutine shift_operator

   !> The motions that answer to forces, in their place; nothing determined along motions
   !> without stiffness, to which forces must be orthogonal.
   subroutine solved(space, op, y)
      type(space_t), intent(in) :: space
      type(operator_t), intent(in) :: op
      real(wp), intent(inout) :: y(:, :)

      if (size(op%loose, 2) > 0) y = y - matmul(op%loose, matmul(transpose(op%loose), y))
      call solve(space%projection%pattern, op%factor, y)
      if (size(op%loose, 2) > 0) y = y - matmul(op%loose, matmul(transpose(op%loose), y))
   end subroutine solved
end module flexact_elastic_operator
