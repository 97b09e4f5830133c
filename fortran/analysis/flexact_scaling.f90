!> Scales that make the rank of D(c) independent of the unit of length, and
!> the tolerance that goes with them.
module flexact_scaling
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, is_position
   use flexact_partition, only: partition_t, axes
   use flexact_jacobian, only: jacobian_t
   use flexact_rounding, only: uncertainty
   use flexact_vectors, only: length_of
   implicit none
   private
   public :: scaling_t, make_scaling, rank_tolerance

   !> The scaled matrix is diag(row) D(c) diag(column).
   type :: scaling_t
      !> Geometric mean of the reference lengths that are not zero [m]; 1
      !> where there is none.
      real(wp) :: characteristic_length = 1.0_wp
      real(wp), allocatable :: row(:)
      real(wp), allocatable :: column(:)
      !> By how much, in the Frobenius norm, the scaled matrix may differ from
      !> that of the scene that was meant, because its numbers are rounded.
      real(wp) :: error_of_rows = 0.0_wp
   end type scaling_t

contains

   !> Rotations are multiplied by the characteristic length L, so that their
   !> columns are divided by it; a row is divided by its norm over all
   !> coordinates, fixed ones too. The norm of what is left of it in D(c) would
   !> blow up the rounding of an element with fixed ends.
   pure subroutine make_scaling(model, partition, jacobian, scaling)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(jacobian_t), intent(in) :: jacobian
      type(scaling_t), intent(out) :: scaling
      integer :: j

      scaling%characteristic_length = geometric_mean(jacobian%length)
      allocate (scaling%column(partition%count%columns), source=1.0_wp)
      do j = 1, partition%count%columns
         if (is_rotation(model, partition%column_label(1, j))) &
            scaling%column(j) = 1/scaling%characteristic_length
      end do
      call scale_rows(model, partition, jacobian, scaling)
      scaling%error_of_rows = error_of_rows(model, partition, jacobian%length, scaling%characteristic_length)
   end subroutine make_scaling

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

   pure subroutine scale_rows(model, partition, jacobian, scaling)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(jacobian_t), intent(in) :: jacobian
      type(scaling_t), intent(inout) :: scaling
      real(wp) :: value
      integer :: entry, i

      allocate (scaling%row(partition%count%rows), source=0.0_wp)
      do entry = 1, jacobian%entries
         i = partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
         if (i == 0) cycle
         value = jacobian%value(entry)
         if (is_rotation(model, jacobian%column(1, entry))) value = value/scaling%characteristic_length
         ! Unlike a sum of squares, this neither overflows nor vanishes.
         scaling%row(i) = hypot(scaling%row(i), value)
      end do
      where (scaling%row > 0)
         scaling%row = 1/scaling%row
      elsewhere
         scaling%row = 1.0_wp
      end where
   end subroutine scale_rows

   !> The root of the sum over rows of the squared error that the numbers of
   !> the scene leave in a row of unit norm.
   pure real(wp) function error_of_rows(model, partition, length, characteristic_length) result(error)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      real(wp), intent(in) :: length(:), characteristic_length
      real(wp), allocatable :: of_element(:)
      integer :: k

      allocate (of_element(model%elements))
      do k = 1, model%elements
         of_element(k) = error_of_direction(model, k, merge(length(k), characteristic_length, length(k) > 0))
      end do
      error = norm2(of_element(partition%row_label(1, :)))
   end function error_of_rows

   !> How far the directions of element k may be turned, no more than makes
   !> them unknown.
   pure real(wp) function error_of_direction(model, k, length) result(error)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(in) :: length
      real(wp) :: misplaced
      integer :: slot

      misplaced = 0.0_wp
      do slot = 1, 3, 2
         associate (node => model%element_node(slot, k))
            if (node > 0) misplaced = max(misplaced, maxval(uncertainty(model%node_value(1:axes, node))))
         end associate
      end do
      error = min(misplaced, length)/length
      associate (vector => model%element_vector(:, k))
         if (any(abs(vector) > 0)) error = max(error, maxval(uncertainty(vector))/length_of(vector))
      end associate
   end function error_of_direction

   !> Singular values of the scaled matrix up to this count as zero: what dgesdd
   !> may get wrong, and what the rounding of the scene's numbers may do.
   pure real(wp) function rank_tolerance(scaling, values) result(tolerance)
      type(scaling_t), intent(in) :: scaling
      real(wp), intent(in) :: values(:)

      tolerance = scaling%error_of_rows
      if (size(values) == 0) return
      tolerance = tolerance + epsilon(tolerance)*max(size(scaling%row), size(scaling%column))*values(1)
   end function rank_tolerance
end module flexact_scaling
