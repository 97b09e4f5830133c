!> Rank and null spaces part by part from complete decompositions.
module flexact_dense_route
   use flexact_kinds, only: wp
   use flexact_answer, only: options_t, answer_t, most_pairs, method_qr
   use flexact_decomposition, only: is_feasible, decompose_by, singular_values_by, status_fine, status_no_memory
   use flexact_modes, only: add_modes
   use flexact_pairs, only: offer_pair
   use flexact_parts, only: shape_of
   use flexact_pivoting, only: pivoted_t, factorise, take_rank, null_spaces, smallest_values
   use flexact_problem, only: problem_t
   use flexact_rank, only: decide_rank
   use flexact_sort, only: sort_descending
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: analyse_dense

   !> Singular values of a part, descending, and all its singular vectors; or, by
   !> the method qr, estimates of the values and the factorisation.
   type :: part_t
      integer, allocatable :: row(:), column(:)
      real(wp), allocatable :: values(:), plain_values(:)
      real(wp), allocatable :: u(:, :), vt(:, :)
      type(pivoted_t) :: pivoted
   end type part_t

contains

   subroutine analyse_dense(problem, options, answer)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(answer_t), intent(inout) :: answer
      type(part_t), allocatable :: part(:)
      integer :: i

      answer%bytes = bytes_needed(problem)
      answer%status = status_no_memory
      if (answer%bytes > options%memory) return
      answer%status = status_fine
      allocate (part(problem%parts%count))
      do i = 1, size(part)
         call decompose_part(problem, i, answer%method, part(i), answer%status)
         if (answer%status /= status_fine) return
      end do
      call merge_values(part, answer)
      answer%decision = decide_rank(problem%scaling, answer%scaled_values, options%tolerance)
      do i = 1, size(part)
         if (answer%method == method_qr) call complete(part(i), answer)
         if (answer%status == status_fine) call take_modes(problem, part(i), answer)
         if (answer%status /= status_fine) return
      end do
      if (answer%method == method_qr) call improve_values(answer)
      ! Pivoted QR may take for larger what it does not look at again.
      answer%confirmed = answer%method /= method_qr
   end subroutine analyse_dense

   !> Bytes for U, V and the matrices of all parts, and for the work on the
   !> largest.
   pure real(wp) function bytes_needed(problem) result(bytes)
      type(problem_t), intent(in) :: problem
      real(wp) :: m, n, work
      integer :: sides(2), i

      bytes = 0.0_wp
      work = 0.0_wp
      do i = 1, problem%parts%count
         sides = shape_of(problem%parts, i)
         m = sides(1)
         n = sides(2)
         bytes = bytes + 8*(m*m + n*n)
         work = max(work, 8*(2*m*n + 4*min(m, n)**2 + 7*min(m, n) + 64*max(m, n)))
      end do
      bytes = bytes + work
   end function bytes_needed

   subroutine decompose_part(problem, i, method, part, status)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i, method
      type(part_t), intent(out) :: part
      integer, intent(out) :: status
      real(wp), allocatable :: dense(:, :)
      integer :: m, n

      associate (p => problem%parts)
         part%row = p%row(p%row_start(i):p%row_start(i + 1) - 1)
         part%column = p%column(p%column_start(i):p%column_start(i + 1) - 1)
      end associate
      m = size(part%row)
      n = size(part%column)
      status = status_no_memory
      if (.not. is_feasible(m, n)) return
      allocate (dense(m, n))
      if (method == method_qr) then
         call estimate_part(problem, dense, part, status)
         return
      end if
      allocate (part%u(m, m), part%vt(n, n), part%values(min(m, n)), part%plain_values(min(m, n)))
      call fill(problem%by_column, part, dense)
      call decompose_by(method, dense, part%values, part%u, part%vt, status)
      if (status /= status_fine) return
      call fill(problem%jacobian, part, dense)
      call singular_values_by(method, dense, part%plain_values, status)
   end subroutine decompose_part

   subroutine estimate_part(problem, dense, part, status)
      type(problem_t), intent(in) :: problem
      real(wp), allocatable, intent(inout) :: dense(:, :)
      type(part_t), intent(inout) :: part
      integer, intent(out) :: status
      type(pivoted_t) :: plain

      call fill(problem%jacobian, part, dense)
      call factorise(dense, plain, status)
      if (status /= status_fine) return
      part%plain_values = plain%estimates
      allocate (dense(size(part%row), size(part%column)))
      call fill(problem%by_column, part, dense)
      call factorise(dense, part%pivoted, status)
      if (status == status_fine) part%values = part%pivoted%estimates
   end subroutine estimate_part

   !> Singular vectors beside the rank, and below it those of the smallest values,
   !> which are computed, no longer estimated: the rank is less where they vanish.
   subroutine complete(part, answer)
      type(part_t), intent(inout) :: part
      type(answer_t), intent(inout) :: answer
      real(wp), allocatable :: values(:), left(:, :), right(:, :), motions(:, :)
      integer :: m, n, rank, k

      m = size(part%row)
      n = size(part%column)
      rank = count(part%values > answer%decision%tolerance)
      allocate (part%u(m, m), part%vt(n, n))
      do
         call take_rank(part%pivoted, rank, answer%status)
         if (answer%status /= status_fine) return
         k = min(rank, most_pairs)
         values = part%values(:k)
         allocate (left(m, k), right(n, k))
         call smallest_values(part%pivoted, values, left, right, answer%status)
         if (answer%status /= status_fine .or. all(values > answer%decision%tolerance)) exit
         answer%decision%rank = answer%decision%rank - count(values <= answer%decision%tolerance)
         rank = rank - count(values <= answer%decision%tolerance)
         deallocate (left, right)
      end do
      if (answer%status /= status_fine) return
      allocate (motions(n, n - rank))
      call null_spaces(part%pivoted, motions, part%u(:, rank + 1:), answer%status)
      part%vt(rank + 1:, :) = transpose(motions)
      part%values(rank + 1:) = min(part%values(rank + 1:), answer%decision%tolerance)
      part%values(rank - k + 1:rank) = values(k:1:-1)
      part%u(:, rank - k + 1:rank) = left(:, k:1:-1)
      part%vt(rank - k + 1:rank, :) = transpose(right(:, k:1:-1))
   end subroutine complete

   !> Put the smallest non-zero values in the place of their estimates.
   pure subroutine improve_values(answer)
      type(answer_t), intent(inout) :: answer
      integer :: rank, k

      rank = answer%decision%rank
      k = size(answer%pair_value)
      answer%scaled_values(rank + 1:) = min(answer%scaled_values(rank + 1:), answer%decision%tolerance)
      answer%scaled_values(:rank - k) = max(answer%scaled_values(:rank - k), maxval(answer%pair_value))
      answer%scaled_values(rank - k + 1:rank) = answer%pair_value(k:1:-1)
   end subroutine improve_values

   !> A part of a matrix with its zeros. Rows of a part ascend.
   pure subroutine fill(matrix, part, dense)
      type(sparse_t), intent(in) :: matrix
      type(part_t), intent(in) :: part
      real(wp), intent(out) :: dense(:, :)
      integer :: j, entry, i

      dense = 0.0_wp
      do j = 1, size(part%column)
         i = 1
         do entry = matrix%start(part%column(j)), matrix%start(part%column(j) + 1) - 1
            do while (part%row(i) < matrix%place(entry))
               i = i + 1
            end do
            dense(i, j) = matrix%value(entry)
         end do
      end do
   end subroutine fill

   !> Singular values of all parts together, descending. Beside them stand the
   !> zeros of a matrix whose parts are not all of full shape.
   pure subroutine merge_values(part, answer)
      type(part_t), intent(in) :: part(:)
      type(answer_t), intent(inout) :: answer
      integer :: i, at, last, rows, columns

      rows = 0
      columns = 0
      do i = 1, size(part)
         rows = rows + size(part(i)%row)
         columns = columns + size(part(i)%column)
      end do
      allocate (answer%scaled_values(min(rows, columns)), answer%singular_values(min(rows, columns)), source=0.0_wp)
      at = 0
      do i = 1, size(part)
         last = at + size(part(i)%values)
         answer%scaled_values(at + 1:last) = part(i)%values
         answer%singular_values(at + 1:last) = part(i)%plain_values
         at = last
      end do
      if (size(part) > 1) then
         call sort_descending(answer%scaled_values)
         call sort_descending(answer%singular_values)
      end if
   end subroutine merge_values

   !> Add the modes of a part to the answer, and offer its smallest non-zero values.
   subroutine take_modes(problem, part, answer)
      type(problem_t), intent(in) :: problem
      type(part_t), intent(inout) :: part
      type(answer_t), intent(inout) :: answer
      real(wp), allocatable :: motions(:, :)
      integer :: rank, k

      rank = count(part%values > answer%decision%tolerance)
      motions = transpose(part%vt(rank + 1:, :))
      call add_modes(motions, part%column, problem%scaling%column(part%column), answer%motions, answer%status)
      if (answer%status /= status_fine) return
      call add_modes(part%u(:, rank + 1:), part%row, problem%scaling%row(part%row), answer%stresses, answer%status)
      do k = rank, max(1, rank - most_pairs + 1), -1
         call offer_pair(answer, part%values(k), part%column, part%vt(k, :), part%row, part%u(:, k))
      end do
   end subroutine take_modes
end module flexact_dense_route
