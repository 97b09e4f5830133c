! SPDX-License-Identifier: BSD-3-Clause
!> Scales that make the rank of D(c) independent of the unit of length, and
!> by how much the scaled matrix may be wrong; theory.md (2) to (6).
module flexact_scaling
   use flexact_components, only: components_t
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t
   use flexact_slots, only: axes, slots, is_position
   use flexact_jacobian, only: jacobian_t
   use flexact_rank, only: rank_rule_t
   use flexact_rounding, only: decimal, decimal_t, difference, last_bits, last_digit, coarsest_digit
   use flexact_scaled_norm, only: length_of
   implicit none
   private
   public :: scaling_t, make_scaling, make_single_length, bound_errors, sound_squares, rank_rule_of, extent_of

   !> A component this many times larger or smaller than the whole has its own length:
   !> lengths within one mechanism differ less, and keep one scale.
   real(wp), parameter :: another_size = 100.0_wp

   !> Sums of squares from here to the inverse have lost nothing.
   real(wp), parameter :: least_square = 1.0e-200_wp

   !> The scaled matrix is diag(row) D(c) diag(column).
   type :: scaling_t
      !> Geometric mean of the reference lengths that are not zero [m]; 1
      !> where there is none.
      real(wp) :: characteristic_length = 1.0_wp
      real(wp), allocatable :: row(:)
      real(wp), allocatable :: column(:)
      !> By how much, in the 2-norm, the scaled matrix may differ from that of
      !> the model that was meant: because of rounding in the last bits, and
      !> because of the digits with which coordinates were typed.
      real(wp) :: error_of_bits = 0.0_wp
      real(wp) :: error_of_digits = 0.0_wp
      !> No more than that can any digits that were left out explain.
      real(wp) :: reach_of_digits = 0.0_wp
   end type scaling_t

contains

   !> Rotations are multiplied by the characteristic length L, so that their
   !> columns are divided by it; a row is divided by its norm over all
   !> coordinates, fixed ones too. The norm of what is left of it in D(c) would
   !> blow up the rounding of an element with fixed ends.
   !>
   !> A connected component of quite another size than the whole has a length of its
   !> own: no scale of one changes the rank of another.
   pure subroutine make_scaling(model, partition, jacobian, components, scaling)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(jacobian_t), intent(in) :: jacobian
      type(components_t), intent(in) :: components
      type(scaling_t), intent(out) :: scaling
      real(wp) :: row_length(partition%count%rows), length
      integer :: i, j

      scaling%characteristic_length = geometric_mean(jacobian%length)
      allocate (scaling%column(partition%count%columns), source=1.0_wp)
      do i = 1, components%count
         associate (row => components%row(components%row_start(i):components%row_start(i + 1) - 1))
            length = geometric_mean(jacobian%length(partition%row_label(1, row)))
            if (.not. any(jacobian%length(partition%row_label(1, row)) > 0) .or. &
                abs(log(length/scaling%characteristic_length)) < log(another_size)) length = scaling%characteristic_length
            row_length(row) = length
         end associate
         do j = components%column_start(i), components%column_start(i + 1) - 1
            associate (column => components%column(j))
               if (is_rotation(model, partition%column_label(1, column))) scaling%column(column) = 1/length
            end associate
         end do
      end do
      call scale_rows(model, partition, jacobian, row_length, scaling)
      call bound_errors(model, partition, jacobian%length, scaling)
   end subroutine make_scaling

   !> The characteristic length where all lengths are of one size, so that components do not
   !> count; else is_single is false.
   pure subroutine make_single_length(length, characteristic_length, is_single)
      real(wp), intent(in) :: length(:)
      real(wp), intent(out) :: characteristic_length
      logical, intent(out) :: is_single

      characteristic_length = geometric_mean(length)
      is_single = .not. any(length > 0)
      if (.not. is_single) is_single = maxval(length) < another_size*minval(length, length > 0)
   end subroutine make_single_length

   !> By which the rank of the scaled matrix is decided.
   pure function rank_rule_of(scaling, tolerance) result(rule)
      type(scaling_t), intent(in) :: scaling
      real(wp), allocatable, intent(in) :: tolerance
      type(rank_rule_t) :: rule

      rule%side = max(size(scaling%row), size(scaling%column))
      rule%error_of_bits = scaling%error_of_bits
      rule%error_of_digits = scaling%error_of_digits
      if (allocated(tolerance)) rule%tolerance = tolerance
   end function rank_rule_of

   pure logical function is_rotation(model, node)
      type(model_t), intent(in) :: model
      integer, intent(in) :: node
      is_rotation = .not. is_position(model%node_kind(node))
   end function is_rotation

   !> Of the positive lengths, kept where its inverse is finite.
   pure real(wp) function geometric_mean(length) result(mean)
      real(wp), intent(in) :: length(:)
      integer :: positive

      positive = count(length > 0)
      mean = 1.0_wp
      if (positive > 0) mean = exp(sum(log(length), length > 0)/positive)
      mean = min(max(mean, tiny(mean)), 1/tiny(mean))
   end function geometric_mean

   pure subroutine scale_rows(model, partition, jacobian, row_length, scaling)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(jacobian_t), intent(in) :: jacobian
      real(wp), intent(in) :: row_length(:)
      type(scaling_t), intent(inout) :: scaling
      real(wp) :: squares(partition%count%rows), value
      integer :: entry, row

      squares = 0.0_wp
      do entry = 1, jacobian%entries
         call take_entry(model, partition, jacobian, row_length, entry, row, value)
         if (row > 0) squares(row) = squares(row) + value**2
      end do
      scaling%row = sqrt(squares)
      if (.not. all(sound_squares(squares))) then
         ! Unlike a sum of squares, this neither overflows nor vanishes.
         scaling%row = 0.0_wp
         do entry = 1, jacobian%entries
            call take_entry(model, partition, jacobian, row_length, entry, row, value)
            if (row > 0) scaling%row(row) = hypot(scaling%row(row), value)
         end do
      end if
      where (scaling%row > 0)
         scaling%row = 1/scaling%row
      elsewhere
         scaling%row = 1.0_wp
      end where
   end subroutine scale_rows

   !> Whether sums of squares have lost nothing.
   elemental logical function sound_squares(squares)
      real(wp), intent(in) :: squares
      sound_squares = (squares >= least_square .or. .not. squares > 0) .and. squares < 1/least_square
   end function sound_squares

   !> The row of an entry, or 0, and its value without the unit of length: by a rotation over the length of the row.
   pure subroutine take_entry(model, partition, jacobian, row_length, entry, row, value)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(jacobian_t), intent(in) :: jacobian
      real(wp), intent(in) :: row_length(:)
      integer, intent(in) :: entry
      integer, intent(out) :: row
      real(wp), intent(out) :: value

      row = partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
      value = jacobian%value(entry)
      if (row == 0) return
      if (is_rotation(model, jacobian%column(1, entry))) value = value/row_length(row)
   end subroutine take_entry

   !> The largest extent of the model along a global axis [m].
   pure real(wp) function extent_of(model) result(extent)
      type(model_t), intent(in) :: model
      real(wp) :: lowest(axes), highest(axes)
      integer :: node

      lowest = huge(lowest)
      highest = -huge(highest)
      do node = 1, model%nodes
         if (.not. is_position(model%node_kind(node))) cycle
         lowest = min(lowest, model%node_value(1:axes, node))
         highest = max(highest, model%node_value(1:axes, node))
      end do
      ! Halved, because a difference may overflow.
      extent = 2*min(max(0.0_wp, maxval(highest/2 - lowest/2)), huge(extent)/2)
   end function extent_of

   !> Errors E whose row i has a norm of at most e_i, and entries in columns P(i) alone, have
   !> a 2-norm of at most the root of the largest sum of e_i**2 over the rows that meet in
   !> one column: |E x|**2 <= sum over i of e_i**2 sum over P(i) of x_j**2, which is the sum
   !> over j of x_j**2 times the sum of e_i**2 over the rows i with j in P(i).
   !> P(i) is all that the element joins: an entry may be zero and its error not.
   pure subroutine bound_errors(model, partition, length, scaling)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      real(wp), intent(in) :: length(:)
      type(scaling_t), intent(inout) :: scaling
      real(wp), allocatable :: squares(:, :)
      type(decimal_t) :: number(axes, model%nodes)
      real(wp) :: extent, error(3)
      integer :: k, slot, axis

      extent = extent_of(model)
      do k = 1, model%nodes
         if (is_position(model%node_kind(k))) number(:, k) = decimal(model%node_value(1:axes, k))
      end do
      allocate (squares(3, partition%count%columns), source=0.0_wp)
      do k = 1, model%elements
         associate (rows => count(partition%row_of(:, k) > 0), node => model%element_node(:, k))
            if (rows == 0) cycle
            error = rows*errors_of_direction(model, k, number, length(k), scaling%characteristic_length, extent)**2
            do slot = 1, slots
               if (node(slot) == 0 .or. any(node(:slot - 1) == node(slot))) cycle
               do axis = 1, axes
                  associate (column => partition%column_of(axis, node(slot)))
                     if (column > 0) squares(:, column) = squares(:, column) + error
                  end associate
               end do
            end do
         end associate
      end do
      if (size(squares) == 0) return
      scaling%error_of_bits = sqrt(maxval(squares(1, :)))
      scaling%error_of_digits = sqrt(maxval(squares(2, :)))
      scaling%reach_of_digits = sqrt(maxval(squares(3, :)))
   end subroutine bound_errors

   !> How far the directions of element k may be turned, by rounding in the last
   !> bits, by many digits typed, and by any; no more than makes them unknown.
   pure function errors_of_direction(model, k, number, length, characteristic_length, extent) result(error)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(decimal_t), intent(in) :: number(:, :)
      real(wp), intent(in) :: length, characteristic_length, extent
      real(wp) :: error(3)

      error = 0.0_wp
      associate (p => model%element_node(1, k), q => model%element_node(3, k), vector => model%element_vector(:, k))
         if (p > 0 .and. q > 0) &
            error = errors_of_offset(model%node_value(1:axes, [p, q]), number(:, p), number(:, q), extent)
         error = min(1.0_wp, error/merge(length, characteristic_length, length > 0))
         if (any(abs(vector) > 0)) &
            error = max(error, errors_of_offset(spread(vector, 2, 1), decimal(0*vector), decimal(vector), &
                                                maxval(abs(vector)))/length_of(vector))
      end associate
   end function errors_of_direction

   !> By how much the vector between two points may be wrong, by the points and by their
   !> digits. Bits are lost where the points stand; digits count from the one to the other.
   pure function errors_of_offset(points, p, q, extent) result(error)
      real(wp), intent(in) :: points(:, :), extent
      type(decimal_t), intent(in) :: p(:), q(:)
      real(wp) :: error(3)
      type(decimal_t) :: offset
      integer :: axis

      error = [maxval(last_bits(points, extent)), 0.0_wp, 0.0_wp]
      do axis = 1, size(p)
         if (.not. (p(axis)%short .and. q(axis)%short)) cycle
         offset = difference(p(axis), q(axis))
         error(2:) = max(error(2:), [last_digit(offset), coarsest_digit(offset)])
      end do
   end function errors_of_offset
end module flexact_scaling
