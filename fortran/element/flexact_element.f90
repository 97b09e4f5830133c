!> An element of any kind: its reference, the poses of its ends, and its
!> deformation functions with their first derivatives.
module flexact_element
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, node_planar_position, node_position, node_angle, node_orientation
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: length_of, frame_along, planar_frame_along
   use flexact_euler, only: relative_rotation
   use flexact_element_table, only: element_kinds, kind_truss, kind_beam, kind_rbeam, kind_pinbody, kind_hinge, &
                                    kind_pltruss, kind_plbeam, kind_plrbeam, kind_plhinge
   use flexact_truss, only: truss_deformation
   use flexact_beam, only: beam_deformation
   use flexact_rbeam, only: rbeam_deformation
   use flexact_hinge, only: hinge_deformation
   use flexact_plbeam, only: plbeam_deformation
   use flexact_plrbeam, only: plrbeam_deformation
   use flexact_plhinge, only: plhinge_deformation
   implicit none
   private
   public :: make_reference, make_poses, element_deformation

contains

   !> What element k measures its deformations from: the reference values of
   !> its nodes and its vector. A beam's ey is the vector made perpendicular to
   !> the line from p to q; a hinge's ex is the vector.
   pure subroutine make_reference(model, k, reference)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(reference_t), intent(out) :: reference
      type(pose_t) :: p, q
      real(wp), parameter :: no_hint(3) = 0.0_wp

      call make_poses(model, k, model%node_value, p, q)
      reference%offset = q%position - p%position
      reference%length = length_of(reference%offset)
      select case (model%element_kind(k))
      case (kind_beam, kind_rbeam, kind_pinbody)
         reference%frame = frame_along(reference%offset, model%element_vector(:, k))
      case (kind_hinge)
         reference%frame = frame_along(model%element_vector(:, k), no_hint)
      case (kind_plbeam, kind_plrbeam)
         reference%frame = planar_frame_along(reference%offset)
      end select
   end subroutine make_reference

   !> The ends of element k in a configuration given as node values,
   !> (4, nodes). A slot without a node leaves its part of the pose at rest; a
   !> planar element sees x and y of its nodes alone.
   pure subroutine make_poses(model, k, configuration, p, q)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(in) :: configuration(:, :)
      type(pose_t), intent(out) :: p, q

      associate (node => model%element_node(:, k), wanted => element_kinds(model%element_kind(k))%slot_kind)
         call place(model, node(1), wanted(1), configuration, p)
         call place(model, node(2), wanted(2), configuration, p)
         call place(model, node(3), wanted(3), configuration, q)
         call place(model, node(4), wanted(4), configuration, q)
      end associate
   end subroutine make_poses

   !> Put into a pose what one node says of it to a slot of this node kind.
   pure subroutine place(model, node, wanted, configuration, pose)
      type(model_t), intent(in) :: model
      integer, intent(in) :: node, wanted
      real(wp), intent(in) :: configuration(:, :)
      type(pose_t), intent(inout) :: pose

      select case (wanted)
      case (node_planar_position)
         pose%position(1:2) = configuration(1:2, node)
      case (node_position)
         pose%position = configuration(1:3, node)
      case (node_angle)
         pose%angle = configuration(1, node) - model%node_value(1, node)
      case (node_orientation)
         pose%rotation = relative_rotation(configuration(:, node), model%node_value(:, node))
      end select
   end subroutine place

   !> Deformations (6) of an element and their derivatives (6, 12) with respect
   !> to the position of p, rotation of p, position of q, rotation of q;
   !> zero beyond the last deformation. A rotation is three instantaneous
   !> components about the global axes, dR = [phi]x R, in radians.
   pure subroutine element_deformation(kind, reference, p, q, e, derivative)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(out) :: e(6), derivative(6, 12)

      select case (kind)
      case (kind_truss, kind_pltruss)
         call truss_deformation(reference, p, q, e, derivative)
      case (kind_beam)
         call beam_deformation(reference, p, q, e, derivative)
      case (kind_rbeam, kind_pinbody)
         call rbeam_deformation(reference, p, q, e, derivative)
      case (kind_hinge)
         call hinge_deformation(reference, p, q, e, derivative)
      case (kind_plbeam)
         call plbeam_deformation(reference, p, q, e, derivative)
      case (kind_plrbeam)
         call plrbeam_deformation(reference, p, q, e, derivative)
      case (kind_plhinge)
         call plhinge_deformation(p, q, e, derivative)
      case default
         e = 0.0_wp
         derivative = 0.0_wp
      end select
   end subroutine element_deformation
end module flexact_element
