!> Scales that make the rank of D(c) independent of the unit of length, and
!> the tolerance that goes with them.
module flexact_scaling
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, is_position
   use flexact_partition, only: partition_t, axes
   use flexact_jacobian, only: jacobian_t
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
      !> Rounding of the coordinates turns the row of an element by about so
      !> many times the machine precision: the root of the sum over rows of
      !> (largest coordinate over length) squared.
      real(wp) :: coordinate_rounding = 0.0_wp
   end type scaling_t

   !> How many roundings of the coordinates are allowed for.
   real(wp), parameter :: safety = 16.0_wp

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
      scaling%coordinate_rounding = rounding_of_coordinates(model, partition, jacobian%length)
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

   pure real(wp) function rounding_of_coordinates(model, partition, length) result(rounding)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      real(wp), intent(in) :: length(:)
      real(wp), allocatable :: ratio(:)
      integer :: i

      allocate (ratio(partition%count%rows))
      do i = 1, size(ratio)
         associate (element => partition%row_label(1, i))
            ratio(i) = coordinate_ratio(farthest_coordinate(model, element), length(element))
         end associate
      end do
      rounding = norm2(ratio)
   end function rounding_of_coordinates

   !> Largest |coordinate| of the positions of element k.
   pure real(wp) function farthest_coordinate(model, k) result(farthest)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      integer :: slot

      farthest = 0.0_wp
      do slot = 1, 3, 2
         associate (node => model%element_node(slot, k))
            if (node > 0) farthest = max(farthest, maxval(abs(model%node_value(1:axes, node))))
         end associate
      end do
   end function farthest_coordinate

   !> Coordinate over length; 1 without a length, and no more than makes the
   !> direction of the element unknown.
   pure real(wp) function coordinate_ratio(farthest, length) result(ratio)
      real(wp), intent(in) :: farthest, length

      if (.not. length > 0) then
         ratio = 1.0_wp
      else if (farthest*epsilon(length) >= length) then
         ratio = 1/epsilon(length)
      else
         ratio = farthest/length
      end if
   end function coordinate_ratio

   !> Singular values of the scaled matrix up to this count as zero: what dgesdd
   !> may get wrong, and what rounding the coordinates may do.
   pure real(wp) function rank_tolerance(scaling, values) result(tolerance)
      type(scaling_t), intent(in) :: scaling
      real(wp), intent(in) :: values(:)
      real(wp) :: computing

      computing = 0.0_wp
      if (size(values) > 0) computing = max(size(scaling%row), size(scaling%column))*values(1)
      tolerance = epsilon(tolerance)*(computing + safety*scaling%coordinate_rounding)
   end function rank_tolerance
end module flexact_scaling
