! SPDX-License-Identifier: BSD-3-Clause
!> Whether a motion and a self-stress are there in exact alignment only: what moving one node,
!> or turning one element, makes of the block of all zeros; theory.md (29).
module flexact_zero_margins
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t
   use flexact_result, only: result_t
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: zero_limits_t, find_zero_changes

   type :: zero_limits_t
      !> How many zeros are looked at, each against how many vectors of the other side, and
      !> how many pairs times nodes and elements there may be.
      integer :: zeros = 0, others = 0
      real(wp) :: work = 0.0_wp
      !> A change of less than this part of the matrix is none.
      real(wp) :: nothing = 0.0_wp
   end type zero_limits_t

contains

   !> moved, turned: whether the move of one node, or the turn of one element, lifts some zero.
   subroutine find_zero_changes(model, problem, result, limits, moved, turned)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      type(result_t), intent(in) :: result
      type(zero_limits_t), intent(in) :: limits
      logical, intent(out) :: moved, turned
      type(sensitivity_t), allocatable :: found(:)
      integer :: pairs, zeros, most, i, j

      moved = .false.
      turned = .false.
      associate (stresses => result%stresses%vectors, motions => result%motions%vectors)
         pairs = int(limits%work)/(model%nodes + model%elements)
         zeros = min(stresses, motions, limits%zeros, max(1, int(sqrt(real(pairs, wp)))))
         if (zeros == 0) return
         most = max(zeros, min(limits%others, pairs/zeros))
         associate (left => unscaled(result%stresses, problem%scaling%row, merge(zeros, most, stresses <= motions)), &
                    right => unscaled(result%motions, problem%scaling%column, merge(most, zeros, stresses <= motions)))
            allocate (found(size(left, 2)*size(right, 2)))
            call find_sensitivities(model, left, right, reshape([((i, j, i=1, size(left, 2)), j=1, size(right, 2))], &
                                                                [2, size(found)]), found, .true.)
         end associate
      end associate
      moved = any(found%by_move*problem%scaling%characteristic_length > limits%nothing)
      turned = any(found%by_turn > limits%nothing)
   end subroutine find_zero_changes

   !> The first vectors of a basis, of unit norm in the scaled matrix.
   pure function unscaled(basis, scale, most) result(vectors)
      type(sparse_basis_t), intent(in) :: basis
      real(wp), intent(in) :: scale(:)
      integer, intent(in) :: most
      real(wp) :: vectors(size(scale), min(most, basis%vectors))
      integer :: k

      vectors = 0.0_wp
      do k = 1, size(vectors, 2)
         associate (place => basis%place(basis%start(k):basis%start(k + 1) - 1), &
                    value => basis%value(basis%start(k):basis%start(k + 1) - 1))
            vectors(place, k) = value/norm2(value/scale(place))
         end associate
      end do
   end function unscaled
end module flexact_zero_margins
