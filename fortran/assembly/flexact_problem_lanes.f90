! SPDX-License-Identifier: BSD-3-Clause
!> The scaled D(c) of several variants of a small model, side by side in lanes: where its entries
!> stand is found once for all of them.
module flexact_problem_lanes
   use flexact_jacobian, only: element_derivative
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_none
   use flexact_partition, only: partition_t
   use flexact_scaling, only: scaling_t, bound_errors, make_single_length, sound_squares
   use flexact_slots, only: axes, slots, is_position, most_deformations
   implicit none
   private
   public :: layout_t, make_layout, problem_lanes_t, new_problem_lanes, take_variant, scale_lanes
   public :: scaling_of, matrix_of

   !> What variants that differ in places alone have in common.
   type :: layout_t
      integer :: rows = 0, columns = 0
      !> Entries of D_x in rows of D(c), those of element k from start(k) to start(k + 1) - 1:
      !> deformation and number of the derivative in the element, row, column or 0, and whether
      !> it is by a rotation.
      integer, allocatable :: start(:), deformation(:), derivative(:), row(:), column(:)
      logical, allocatable :: is_rotation(:)
      !> Whether each column is a rotation.
      logical, allocatable :: is_turn(:)
   end type layout_t

   type :: problem_lanes_t
      !> Entries of D_x, and of the scaled D(c), (lanes, entries).
      real(wp), allocatable :: plain(:, :), value(:, :)
      !> Scales of rows, (lanes, rows); a rotation's is one over the characteristic length.
      real(wp), allocatable :: row(:, :)
      !> Of each lane the length and the errors; rows and columns stand above.
      type(scaling_t), allocatable :: scaling(:)
      !> Whether there is a variant, and one length scales it all.
      logical, allocatable :: is_made(:)
   end type problem_lanes_t

contains

   pure subroutine make_layout(model, partition, layout)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(layout_t), intent(out) :: layout
      integer :: k, pass, entries

      layout%rows = partition%count%rows
      layout%columns = partition%count%columns
      allocate (layout%start(model%elements + 1))
      do pass = 1, 2
         entries = 0
         do k = 1, model%elements
            layout%start(k) = entries + 1
            call add_element(model, partition, k, layout, entries)
         end do
         layout%start(model%elements + 1) = entries + 1
         if (pass == 1) allocate (layout%deformation(entries), layout%derivative(entries), layout%row(entries), &
                                  layout%column(entries), layout%is_rotation(entries))
      end do
      layout%is_turn = .not. is_position(model%node_kind(partition%column_label(1, :)))
   end subroutine make_layout

   !> Count the entries of element k, and put them down where there is room. Of nodes at both ends
   !> the first slot has the derivatives.
   pure subroutine add_element(model, partition, k, layout, entries)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      integer, intent(in) :: k
      type(layout_t), intent(inout) :: layout
      integer, intent(inout) :: entries
      integer :: i, slot, axis

      do i = 1, most_deformations
         if (partition%row_of(i, k) == 0) cycle
         do slot = 1, slots
            associate (node => model%element_node(slot, k))
               if (node == 0 .or. any(model%element_node(:slot - 1, k) == node)) cycle
               do axis = 1, axes
                  if (model%coordinate_class(axis, node) == class_none) cycle
                  entries = entries + 1
                  if (.not. allocated(layout%row)) cycle
                  layout%deformation(entries) = i
                  layout%derivative(entries) = axes*(slot - 1) + axis
                  layout%row(entries) = partition%row_of(i, k)
                  layout%column(entries) = partition%column_of(axis, node)
                  layout%is_rotation(entries) = .not. is_position(model%node_kind(node))
               end do
            end associate
         end do
      end do
   end subroutine add_element

   pure subroutine new_problem_lanes(layout, lanes, problem)
      type(layout_t), intent(in) :: layout
      integer, intent(in) :: lanes
      type(problem_lanes_t), intent(out) :: problem

      allocate (problem%plain(lanes, size(layout%row)), problem%value(lanes, size(layout%row)), source=0.0_wp)
      allocate (problem%row(lanes, layout%rows), source=1.0_wp)
      allocate (problem%is_made(lanes), source=.false.)
      allocate (problem%scaling(lanes))
   end subroutine new_problem_lanes

   !> Put a variant into a lane, but for its scales.
   pure subroutine take_variant(model, partition, layout, lane, problem)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(layout_t), intent(in) :: layout
      integer, intent(in) :: lane
      type(problem_lanes_t), intent(inout) :: problem
      real(wp) :: derivative(most_deformations, axes*slots), length(model%elements)
      integer :: k, entry

      do k = 1, model%elements
         call element_derivative(model, k, derivative, length(k))
         do entry = layout%start(k), layout%start(k + 1) - 1
            problem%plain(lane, entry) = derivative(layout%deformation(entry), layout%derivative(entry))
         end do
      end do
      call make_single_length(length, problem%scaling(lane)%characteristic_length, problem%is_made(lane))
      if (problem%is_made(lane)) call bound_errors(model, partition, length, problem%scaling(lane))
   end subroutine take_variant

   !> The scales of all lanes that are made, and the scaled entries; where squares lose digits
   !> nothing is made.
   pure subroutine scale_lanes(layout, problem)
      type(layout_t), intent(in) :: layout
      type(problem_lanes_t), intent(inout) :: problem
      real(wp) :: squares(size(problem%row, 1), layout%rows), length(size(problem%row, 1)), turn(size(problem%row, 1))
      integer :: entry

      length = problem%scaling%characteristic_length
      turn = 1/length
      squares = 0.0_wp
      do entry = 1, size(layout%row)
         associate (row => layout%row(entry))
            if (layout%is_rotation(entry)) then
               squares(:, row) = squares(:, row) + (problem%plain(:, entry)/length)**2
            else
               squares(:, row) = squares(:, row) + problem%plain(:, entry)**2
            end if
         end associate
      end do
      problem%is_made = problem%is_made .and. all(sound_squares(squares), 2)
      where (squares > 0)
         problem%row = 1/sqrt(squares)
      elsewhere
         problem%row = 1.0_wp
      end where
      do entry = 1, size(layout%row)
         associate (row => layout%row(entry))
            if (layout%is_rotation(entry)) then
               problem%value(:, entry) = problem%plain(:, entry)*(problem%row(:, row)*turn)
            else
               problem%value(:, entry) = problem%plain(:, entry)*problem%row(:, row)
            end if
         end associate
      end do
   end subroutine scale_lanes

   !> The scales of a lane, with rows and columns.
   pure function scaling_of(layout, problem, lane) result(scaling)
      type(layout_t), intent(in) :: layout
      type(problem_lanes_t), intent(in) :: problem
      integer, intent(in) :: lane
      type(scaling_t) :: scaling

      scaling = problem%scaling(lane)
      scaling%row = problem%row(lane, :)
      scaling%column = merge(1/scaling%characteristic_length, 1.0_wp, layout%is_turn)
   end function scaling_of

   !> D(c) of a lane as a dense matrix, of its plain entries or of the scaled ones.
   pure function matrix_of(layout, entries, lane) result(matrix)
      type(layout_t), intent(in) :: layout
      real(wp), intent(in) :: entries(:, :)
      integer, intent(in) :: lane
      real(wp) :: matrix(layout%rows, layout%columns)
      integer :: entry

      matrix = 0.0_wp
      do entry = 1, size(layout%row)
         if (layout%column(entry) > 0) matrix(layout%row(entry), layout%column(entry)) = entries(lane, entry)
      end do
   end function matrix_of
end module flexact_problem_lanes
