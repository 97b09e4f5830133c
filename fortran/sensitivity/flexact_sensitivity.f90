! SPDX-License-Identifier: BSD-3-Clause
!> What a small change of the geometry makes of a singular value.
!>
!> A change dD of D(c) changes the singular value of a self-stress u and a
!> motion v by u' dD v, to first order; of several zeros it is the block of all
!> pairs that counts. The geometry is the positions of the nodes and the vectors
!> of the elements, in the reference configuration, with lengths and frames; theory.md
!> (20), (21) and (29).
module flexact_sensitivity
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_effects, only: geometry_t, make_geometry, find_effects, parameters
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_slots, only: axes, is_position
   use flexact_rounding, only: decimal, decimal_t, difference, digits_of, half_bit, half_units, last_bits, looks_printed, &
                               looks_rounded
   use flexact_scaling, only: extent_of
   use flexact_vectors, only: cross
   implicit none
   private
   public :: sensitivity_t, find_sensitivities, find_sensitivities_within

   !> Of several that change as much as can be told, the first is named.
   real(wp), parameter :: more = 1 + 1.0e-6_wp

   !> Of so many nodes one is where digits are counted from.
   integer, parameter :: most_origins = 12
   !> And coordinates have so many from there at most: lengths of many sizes tell no place.
   integer, parameter :: few_digits = 4

   !> Zeros that were turned are no larger than this part of the geometry.
   real(wp), parameter :: remnant = 16*epsilon(1.0_wp)

   !> Of one pair of vectors.
   type :: sensitivity_t
      !> What rounding in the last bits, and of the digits typed, can make of
      !> its singular value: the sum over all numbers of the geometry.
      real(wp) :: lift_of_bits = 0.0_wp
      real(wp) :: lift_of_digits = 0.0_wp
      !> What storing it, or printing it with ten digits or a few more, can make of it.
      real(wp) :: lift_of_storing = 0.0_wp
      !> The node that changes it most where it is moved, and the largest
      !> change in units of the vectors by length; 0 where there is none.
      integer :: node = 0
      real(wp) :: by_move = 0.0_wp
      !> The same for the element that is turned about its centre, by angle.
      integer :: element = 0
      real(wp) :: by_turn = 0.0_wp
   end type sensitivity_t

contains

   !> Columns of u (rows, :) and of v (columns, :) are vectors of D(c) without
   !> its scales; pair (2, :) names the columns of each pair. only_margins: lifts are not wanted.
   subroutine find_sensitivities(model, u, v, pair, found, only_margins)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: u(:, :), v(:, :)
      integer, intent(in) :: pair(:, :)
      type(sensitivity_t), intent(out) :: found(:)
      logical, intent(in), optional :: only_margins
      type(partition_t) :: partition

      call make_partition(model, partition)
      call find_sensitivities_within(model, partition, u, v, pair, found, only_margins)
   end subroutine find_sensitivities

   !> The same where the rows and columns of D(c) are numbered already.
   subroutine find_sensitivities_within(model, partition, u, v, pair, found, only_margins)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      real(wp), intent(in) :: u(:, :), v(:, :)
      integer, intent(in) :: pair(:, :)
      type(sensitivity_t), intent(out) :: found(:)
      logical, intent(in), optional :: only_margins
      type(geometry_t) :: geometry
      real(wp), allocatable :: by_node(:, :, :)
      real(wp) :: ue(6, size(u, 2)), ve(12, size(v, 2)), effect(parameters), nothing(2)
      logical :: with_lifts
      integer :: k, i

      with_lifts = .true.
      if (present(only_margins)) with_lifts = .not. only_margins
      ! Behind the effects of each node stands what is nothing beside them.
      allocate (by_node(axes + 1, size(pair, 2), model%nodes), source=0.0_wp)
      do k = 1, model%elements
         call gather(u, partition%row_of(:, k), ue)
         if (.not. any(abs(ue) > 0)) cycle
         call gather_ends(model, partition, k, v, ve)
         call make_geometry(model, k, geometry)
         do i = 1, size(pair, 2)
            call find_effects(geometry, ue(:, pair(1, i)), ve(:, pair(2, i)), effect, nothing)
            call add_element(model, k, geometry, effect, nothing, by_node(:, i, :), found(i))
            if (with_lifts) call add_lifts_of_vector(model%element_vector(:, k), effect(4:6), found(i))
         end do
      end do
      call find_moves(model, by_node, found)
      if (with_lifts) call add_lifts_of_nodes(model, by_node, found)
   end subroutine find_sensitivities_within

   !> Rows of a matrix by their numbers; zeros for number 0.
   pure subroutine gather(matrix, number, rows)
      real(wp), intent(in) :: matrix(:, :)
      integer, intent(in) :: number(:)
      real(wp), intent(out) :: rows(:, :)
      integer :: i

      rows = 0.0_wp
      do i = 1, size(number)
         if (number(i) > 0) rows(i, :) = matrix(number(i), :)
      end do
   end subroutine gather

   !> What the ends of element k do in each motion, in the order of the
   !> derivatives: position of p, rotation of p, position of q, rotation of q.
   pure subroutine gather_ends(model, partition, k, v, ends)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      integer, intent(in) :: k
      real(wp), intent(in) :: v(:, :)
      real(wp), intent(out) :: ends(:, :)
      integer :: slot

      ends = 0.0_wp
      do slot = 1, 4
         associate (node => model%element_node(slot, k), first => axes*(slot - 1))
            if (node > 0) call gather(v, partition%column_of(:, node), ends(first + 1:first + axes, :))
         end associate
      end do
   end subroutine gather_ends

   !> Effects at the ends of element k, of its vector, and of turning it. The
   !> element alone is turned; others at its nodes stay where they are.
   pure subroutine add_element(model, k, geometry, effect, nothing, by_node, found)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(geometry_t), intent(in) :: geometry
      real(wp), intent(in) :: effect(parameters), nothing(2)
      real(wp), intent(inout) :: by_node(:, :)
      type(sensitivity_t), intent(inout) :: found
      real(wp) :: by_turn

      associate (p => model%element_node(1, k), q => model%element_node(3, k), &
                 vector => model%element_vector(:, k), of_offset => effect(1:3), of_vector => effect(4:6))
         if (p > 0 .and. q > 0) then
            by_node(:, p) = by_node(:, p) + [-of_offset, nothing(1)]
            by_node(:, q) = by_node(:, q) + [of_offset, nothing(1)]
         end if
         by_turn = norm2(cross(geometry%offset, of_offset) + cross(vector, of_vector))
         if (by_turn <= nothing(1)*norm2(geometry%offset) + nothing(2)*norm2(vector)) return
         if (by_turn > more*found%by_turn) then
            found%by_turn = by_turn
            found%element = k
         end if
      end associate
   end subroutine add_element

   !> What the numbers of an element's vector may make.
   pure subroutine add_lifts_of_vector(vector, effect, found)
      real(wp), intent(in) :: vector(:), effect(:)
      type(sensitivity_t), intent(inout) :: found
      real(wp) :: units(axes)

      if (.not. any(abs(effect) > 0)) return
      found%lift_of_bits = found%lift_of_bits + dot_product(abs(effect), last_bits(vector, maxval(abs(vector))))
      found%lift_of_digits = found%lift_of_digits + dot_product(abs(effect), half_units_of(vector))
      units = stored_or_printed(vector, decimal(vector), .true., maxval(abs(vector)))
      found%lift_of_storing = found%lift_of_storing + dot_product(abs(effect), units)
   end subroutine add_lifts_of_vector

   !> By how much a number may be wrong that was stored or printed, in a geometry of this
   !> size: half a unit of its last bit, or of its last digit. What is no more than some
   !> last bits of the size, in many digits, is what a turn has left of a zero.
   elemental real(wp) function stored_or_printed(value, number, printed, extent) result(half)
      real(wp), intent(in) :: value, extent
      type(decimal_t), intent(in) :: number
      logical, intent(in) :: printed

      half = half_bit(value)
      if (.not. number%short .and. abs(value) < remnant*extent) half = half_bit(extent)
      if (printed .and. looks_printed(number)) half = 0.5_wp*10.0_wp**number%place
   end function stored_or_printed

   pure function half_units_of(vector) result(half)
      real(wp), intent(in) :: vector(:)
      real(wp) :: half(size(vector))
      half = half_units(decimal(vector), looks_rounded(decimal(vector)))
   end function half_units_of

   !> The node that changes each value most where it is moved.
   pure subroutine find_moves(model, by_node, found)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: by_node(:, :, :)
      type(sensitivity_t), intent(inout) :: found(:)
      real(wp) :: by_move
      integer :: node, i

      do node = 1, model%nodes
         if (.not. is_position(model%node_kind(node))) cycle
         do i = 1, size(found)
            by_move = norm2(by_node(1:axes, i, node))
            if (by_move > max(by_node(axes + 1, i, node), more*found(i)%by_move)) then
               found(i)%by_move = by_move
               found(i)%node = node
            end if
         end do
      end do
   end subroutine find_moves

   !> What the numbers of the nodes' positions may make.
   pure subroutine add_lifts_of_nodes(model, by_node, found)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: by_node(:, :, :)
      type(sensitivity_t), intent(inout) :: found(:)
      type(decimal_t), allocatable :: number(:, :), counted(:, :)
      logical, allocatable :: rounded(:, :)
      logical :: printed(axes)
      real(wp) :: half(axes), bits(axes), units(axes), extent
      integer :: node, i, finest(axes)

      allocate (number(axes, model%nodes), rounded(axes, model%nodes))
      number = decimal(model%node_value(1:axes, :))
      counted = number
      call count_from_a_node(model, counted, finest)
      call find_rounded(model, counted, rounded, printed)
      do node = 1, model%nodes
         counted(:, node) = to_place(counted(:, node), finest)
      end do
      extent = extent_of(model)
      do node = 1, model%nodes
         if (.not. is_position(model%node_kind(node))) cycle
         half = half_units(counted(:, node), rounded(:, node))
         bits = last_bits(model%node_value(1:axes, node), extent)
         units = stored_or_printed(model%node_value(1:axes, node), number(:, node), printed, extent)
         do i = 1, size(found)
            associate (change => abs(by_node(1:axes, i, node)), item => found(i))
               item%lift_of_bits = item%lift_of_bits + dot_product(change, bits)
               item%lift_of_digits = item%lift_of_digits + dot_product(change, half)
               item%lift_of_storing = item%lift_of_storing + dot_product(change, units)
            end associate
         end do
      end do
   end subroutine add_lifts_of_nodes

   !> Coordinates along each axis from that of a node on, with the fewest digits, where all have
   !> few so: what was moved by decimals has more of them, and is known no worse.
   !> Finest: the last place that any of them has then; of other axes none.
   pure subroutine count_from_a_node(model, number, finest)
      type(model_t), intent(in) :: model
      type(decimal_t), intent(inout) :: number(:, :)
      integer, intent(out) :: finest(:)
      type(decimal_t) :: from_node(model%nodes), best(model%nodes)
      integer :: digits(model%nodes), axis, node, looked_at, fewest, last
      logical :: is_place(model%nodes), is_apart(model%nodes)

      is_place = is_position(model%node_kind)
      finest = huge(finest)
      do axis = 1, axes
         if (.not. all(number(axis, :)%short .or. .not. is_place)) cycle
         digits = digits_of(number(axis, :))
         is_apart = is_place .and. digits > 0
         ! All digits, and not to one place: they were rounded to a number of digits.
         if (3*count(digits == maxval(digits) .and. number(axis, :)%place > minval(number(axis, :)%place, is_apart) &
                     .and. is_apart) > count(is_apart)) cycle
         best = number(axis, :)
         fewest = huge(fewest)
         looked_at = 0
         do node = 1, model%nodes
            if (.not. is_place(node)) cycle
            looked_at = looked_at + 1
            if (looked_at > most_origins) exit
            from_node = difference(number(axis, node), number(axis, :))
            if (.not. all(from_node%short .or. .not. is_place)) cycle
            is_apart = is_place .and. from_node%mantissa /= 0
            associate (left => digits_of(from_node))
               if (sum(left, is_apart) >= fewest) cycle
               last = minval(from_node%place, is_apart)
               if (any(left + from_node%place - last > few_digits .and. is_apart)) cycle
               fewest = sum(left, is_apart)
               best = from_node
               finest(axis) = last
            end associate
         end do
         number(axis, :) = best
      end do
   end subroutine count_from_a_node

   !> A number with the zeros that it has up to a place.
   elemental type(decimal_t) function to_place(number, place)
      type(decimal_t), intent(in) :: number
      integer, intent(in) :: place

      to_place = number
      if (number%mantissa == 0 .or. number%place <= place .or. digits_of(number) + number%place - place > 15) return
      to_place%mantissa = number%mantissa*10_int64**(number%place - place)
      to_place%place = place
   end function to_place

   !> Which coordinates look rounded, both by themselves and, along their axis, as
   !> seen along some element: the joints 100, 101, ... of a lattice do not. Along
   !> which axes numbers were printed is told by what elements see, too.
   pure subroutine find_rounded(model, number, rounded, printed)
      type(model_t), intent(in) :: model
      type(decimal_t), intent(in) :: number(:, :)
      logical, intent(out) :: rounded(:, :), printed(axes)
      logical :: some(axes)
      type(decimal_t) :: offset(axes)
      integer :: k, node

      some = .false.
      printed = .false.
      do k = 1, model%elements
         associate (p => model%element_node(1, k), q => model%element_node(3, k))
            if (p == 0 .or. q == 0) cycle
            offset = difference(number(:, p), number(:, q))
            some = some .or. looks_rounded(offset)
            printed = printed .or. looks_printed(offset)
         end associate
      end do
      do node = 1, model%nodes
         rounded(:, node) = some .and. looks_rounded(number(:, node))
      end do
   end subroutine find_rounded
end module flexact_sensitivity
