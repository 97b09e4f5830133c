! SPDX-License-Identifier: BSD-3-Clause
!> What is left of singular values that a decomposition cannot tell from zero. With
!> A = U diag(s) V', U0 and V0 the vectors of the small values, U1 and V1 the others,
!>
!>     V0 <- V0 - V1 diag(s1)^-1 U1' A V0,   U0 <- U0 - U1 diag(s1)^-1 V1' A' U0
!>
!> converges, by a factor of eps/s1 a step, to the invariant spaces, and U0' A V0 is
!> the block that remains when all others are eliminated: its singular values are the
!> small ones of A. A and the vectors have more than 30 digits; theory.md (19).
module flexact_refined_zeros
   use flexact_decomposition, only: decompose_by, method_jacobi
   use flexact_error, only: error_t
   use flexact_kinds, only: wp, qp
   implicit none
   private
   public :: many_digits_t, refined_zeros_t, refine_zeros, least_told

   !> Below this part of the matrix nothing is told from zero even so.
   real(wp), parameter :: least_told = 1.0e-31_wp
   integer, parameter :: most_rounds = 12

   !> A matrix of norm about one, row by row.
   type :: many_digits_t
      integer :: columns = 0
      integer, allocatable :: start(:), place(:)
      real(qp), allocatable :: value(:)
   end type many_digits_t

   !> The small values, descending, with their vectors: left (rows, :) and right
   !> (columns, :); those beyond the values belong to none.
   type :: refined_zeros_t
      real(wp), allocatable :: value(:), left(:, :), right(:, :)
   end type refined_zeros_t

contains

   !> u (m, m), vt (n, n), values (min(m, n)) from rank + 1 on are small.
   subroutine refine_zeros(matrix, u, values, vt, rank, zeros, error)
      type(many_digits_t), intent(in) :: matrix
      real(wp), intent(in) :: u(:, :), values(:), vt(:, :)
      integer, intent(in) :: rank
      type(refined_zeros_t), intent(out) :: zeros
      type(error_t), allocatable, intent(out) :: error
      real(qp), allocatable :: left(:, :), right(:, :), block(:, :)
      real(wp), allocatable :: rotation(:, :), turned(:, :), small(:, :)
      real(qp) :: size_of_block

      left = u(:, rank + 1:)
      right = transpose(vt(rank + 1:, :))
      call converge(matrix, u(:, :rank), values(:rank), vt(:rank, :), right)
      call converge(transposed(matrix, size(u, 1)), transpose(vt(:rank, :)), values(:rank), transpose(u(:, :rank)), left)
      block = matmul(transpose(left), times(matrix, right))
      size_of_block = maxval(abs(block))
      allocate (zeros%value(minval(shape(block))), source=0.0_wp)
      if (size_of_block > least_told*1.0e-3_qp) then
         small = real(block/size_of_block, wp)
         allocate (rotation(size(block, 1), size(block, 1)), turned(size(block, 2), size(block, 2)))
         call decompose_by(method_jacobi, small, zeros%value, rotation, turned, error)
         if (allocated(error)) return
         zeros%value = zeros%value*real(size_of_block, wp)
         left = matmul(left, real(rotation, qp))
         right = matmul(right, real(transpose(turned), qp))
      end if
      zeros%left = real(left, wp)
      zeros%right = real(right, wp)
   end subroutine refine_zeros

   !> Take out of the columns of `small` what the other vectors have of them; ut and
   !> vt as in the formula, u (m, r) and vt (r, n).
   subroutine converge(matrix, u, values, vt, small)
      type(many_digits_t), intent(in) :: matrix
      real(wp), intent(in) :: u(:, :), values(:), vt(:, :)
      real(qp), intent(inout) :: small(:, :)
      real(wp), allocatable :: part(:, :)
      real(wp) :: change, latest
      integer :: round, k

      latest = huge(latest)
      do round = 1, most_rounds
         part = matmul(transpose(u), real(times(matrix, small), wp))
         do k = 1, size(part, 2)
            part(:, k) = part(:, k)/values
         end do
         change = 0.0_wp
         if (size(part) > 0) change = maxval(abs(part))
         if (.not. change < 0.5_wp*latest) exit
         small = small - matmul(transpose(vt), part)
         latest = change
         if (change < 1.0e-34_wp) exit
      end do
   end subroutine converge

   pure function times(matrix, vectors) result(product)
      type(many_digits_t), intent(in) :: matrix
      real(qp), intent(in) :: vectors(:, :)
      real(qp) :: product(size(matrix%start) - 1, size(vectors, 2))
      integer :: i, k, entry

      product = 0.0_qp
      do k = 1, size(vectors, 2)
         do i = 1, size(product, 1)
            do entry = matrix%start(i), matrix%start(i + 1) - 1
               product(i, k) = product(i, k) + matrix%value(entry)*vectors(matrix%place(entry), k)
            end do
         end do
      end do
   end function times

   pure function transposed(matrix, rows) result(other)
      type(many_digits_t), intent(in) :: matrix
      integer, intent(in) :: rows
      type(many_digits_t) :: other
      integer :: next(matrix%columns), i, entry, entries

      entries = matrix%start(rows + 1) - 1
      other%columns = rows
      allocate (other%start(matrix%columns + 1), other%place(entries), other%value(entries))
      other%start(1) = 1
      do i = 1, matrix%columns
         other%start(i + 1) = other%start(i) + count(matrix%place(:entries) == i)
      end do
      next = other%start(:matrix%columns)
      do i = 1, rows
         do entry = matrix%start(i), matrix%start(i + 1) - 1
            associate (at => next(matrix%place(entry)))
               other%place(at) = i
               other%value(at) = matrix%value(entry)
               at = at + 1
            end associate
         end do
      end do
   end function transposed
end module flexact_refined_zeros
