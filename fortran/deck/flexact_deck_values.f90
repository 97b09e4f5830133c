!> The X statements: reference values of the nodes.
module flexact_deck_values
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_deck_scene, only: scene_t, take_node
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_keywords, only: role_value
   use flexact_kinds, only: wp
   use flexact_model, only: node_planar_position, node_position, node_angle
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

   !> Give the nodes the values that the X statements state; of two for one
   !> node the last counts.
   subroutine read_values(text, statements, scene, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(in) :: statements(:)
      type(scene_t), intent(inout) :: scene
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: stated(scene%model%nodes)
      type(operands_t) :: operands
      integer :: i, node

      do i = 1, size(statements)
         if (statements(i)%role /= role_value) cycle
         operands = operands_of(statements(i))
         call take_node(text, scene, operands, node, diagnostics)
         if (node == 0) then
            ! The node that may have been meant is not known.
            node = scene%nodes%find(leading_integer(text(operands%word%first:operands%word%last)))
            if (node > 0) scene%model%node_value(:, node) = ieee_value(1.0_wp, ieee_quiet_nan)
            cycle
         end if
         if (stated(node)%first > 0) then
            call diagnostics%warning('repeated-value', operands%word, &
                                     'the node has a value already', 'this one counts', &
                                     'remove one of the two statements', stated(node))
         end if
         stated(node) = operands%word
         call read_value(text, operands, scene%model%node_kind(node), scene%model%node_value(:, node), diagnostics)
         ! Not known: what is measured with it is not reported as well.
         if (.not. operands%fine) scene%model%node_value(:, node) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
   end subroutine read_values

   subroutine read_value(text, operands, kind, value, diagnostics)
      character(len=*), intent(in) :: text
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: kind
      real(wp), intent(inout) :: value(4)
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: all_of_them
      integer :: i

      select case (kind)
      case (node_planar_position)
         do i = 1, 2
            call operands%real_number(text, coordinate(i), value(i), diagnostics)
         end do
         if (operands%fine) call operands%finish(text, 'X n x y for a node of planar elements', diagnostics)
      case (node_position)
         do i = 1, 3
            call operands%real_number(text, coordinate(i), value(i), diagnostics)
         end do
         if (operands%fine) call operands%finish(text, 'X n x y z', diagnostics)
      case (node_angle)
         call operands%real_number(text, 'angle', value(1), diagnostics)
         if (operands%fine) call operands%finish(text, 'X n angle for an orientation node of planar elements', diagnostics)
      case default
         do i = 1, 4
            call operands%real_number(text, euler_parameter(i), value(i), diagnostics)
            if (i == 1) all_of_them = operands%word
         end do
         all_of_them%last = operands%word%last
         if (operands%fine) call operands%finish(text, 'X n lambda0 lambda1 lambda2 lambda3 for an orientation node', diagnostics)
         if (operands%fine) call check_norm(all_of_them, value, diagnostics)
      end select
   end subroutine read_value

   subroutine check_norm(place, value, diagnostics)
      type(span_t), intent(in) :: place
      real(wp), intent(in) :: value(4)
      type(diagnostics_t), intent(inout) :: diagnostics
      real(wp) :: norm

      norm = length_of(value)
      if (norm <= 0.0_wp .or. norm > huge(norm)) then
         call diagnostics%error('bad-orientation', place, 'these Euler parameters describe no orientation', &
                                'their norm is zero or not finite', 'write 1 0 0 0 for no rotation')
      else if (abs(norm - 1.0_wp) > norm_slack) then
         call diagnostics%warning('bad-orientation', place, 'the norm of these Euler parameters is not 1', &
                                  'used after division by the norm', 'write parameters of norm 1')
      end if
   end subroutine check_norm
end module flexact_deck_values
