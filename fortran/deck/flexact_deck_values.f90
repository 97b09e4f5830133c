! SPDX-License-Identifier: BSD-3-Clause
!> The X statements: reference values of the nodes.
module flexact_deck_values
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_deck_model, only: deck_model_t, take_node
   use flexact_diagnostics, only: span_t
   use flexact_keywords, only: role_value
   use flexact_kinds, only: wp
   use flexact_slots, only: node_planar_position, node_position, node_angle, is_position
   use flexact_numbers, only: leading_integer
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   use flexact_vectors, only: length_of
   implicit none
   private
   public :: read_values

   !> Euler parameters are as good as typed when their norm is this near to one.
   real(wp), parameter :: norm_slack = 1.0e-6_wp

   character(len=*), parameter :: coordinate(3) = ['coordinate x', 'coordinate y', 'coordinate z']
   character(len=*), parameter :: euler_parameter(4) = ['Euler parameter lambda0', 'Euler parameter lambda1', &
                                                        'Euler parameter lambda2', 'Euler parameter lambda3']

contains

   !> Give the nodes the values that the X statements state, and their comments as
   !> names; of two for one node the last counts.
   subroutine read_values(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(span_t) :: stated(deck%model%nodes)
      type(operands_t) :: operands
      integer :: i, node

      do i = 1, size(statements)
         if (statements(i)%role /= role_value) cycle
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         operands%length_power = deck%length_power
         call take_node(deck, operands, node)
         if (node == 0) then
            ! The node that may have been meant is not known.
            node = deck%nodes%find(leading_integer(operands%spelling()))
            if (node > 0) deck%model%node_value(:, node) = ieee_value(1.0_wp, ieee_quiet_nan)
            cycle
         end if
         if (stated(node)%first > 0) then
            call operands%diagnostics%warning('repeated-value', operands%word, &
                                              'the node has a value already', 'this one counts', &
                                              'remove one of the two statements', stated(node))
         end if
         stated(node) = operands%word
         deck%model%node_origin(node) = statements(i)%keyword%first
         if (statements(i)%comment%first > 0) deck%node_names(node) = statements(i)%comment
         call read_value(operands, deck%model%node_kind(node), deck%model%node_value(:, node))
         if (is_position(deck%model%node_kind(node)) .and. .not. operands%is_short) deck%has_long_numbers = .true.
         ! Not known: what is measured with it is not reported as well.
         if (.not. operands%fine) deck%model%node_value(:, node) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
   end subroutine read_values

   subroutine read_value(operands, kind, value)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: kind
      real(wp), intent(inout) :: value(4)

      select case (kind)
      case (node_planar_position)
         call take_values(operands, coordinate(:2), 1, 'X n x y for a node of planar elements', value)
      case (node_position)
         call take_values(operands, coordinate, 1, 'X n x y z', value)
      case (node_angle)
         call take_values(operands, ['angle'], 0, 'X n angle for an orientation node of planar elements', value)
      case default
         call take_values(operands, euler_parameter, 0, 'X n lambda0 lambda1 lambda2 lambda3 for an orientation node', value)
         if (operands%fine) call check_norm(operands, value)
      end select
   end subroutine read_value

   !> Take the numbers of a statement of this form, in whose units a length has a power; their
   !> place becomes the word that was taken last.
   subroutine take_values(operands, what, lengths, form, value)
      type(operands_t), intent(inout) :: operands
      character(len=*), intent(in) :: what(:), form
      integer, intent(in) :: lengths
      real(wp), intent(inout) :: value(4)
      integer :: i, first

      do i = 1, size(what)
         call operands%real_number(what(i), value(i), lengths)
         if (i == 1) first = operands%word%first
      end do
      if (operands%fine) call operands%finish(form)
      operands%word%first = first
   end subroutine take_values

   subroutine check_norm(operands, value)
      type(operands_t), intent(in) :: operands
      real(wp), intent(in) :: value(4)
      real(wp) :: norm

      norm = length_of(value)
      associate (diagnostics => operands%diagnostics, place => operands%word)
      if (norm <= 0.0_wp .or. norm > huge(norm)) then
         call diagnostics%error('bad-orientation', place, 'these Euler parameters describe no orientation', &
                                'their norm is zero or not finite', 'write 1 0 0 0 for no rotation')
      else if (abs(norm - 1.0_wp) > norm_slack) then
         call diagnostics%warning('bad-orientation', place, 'the norm of these Euler parameters is not 1', &
                                  'used after division by the norm', 'write parameters of norm 1')
      end if
      end associate
   end subroutine check_norm
end module flexact_deck_values
