! SPDX-License-Identifier: BSD-3-Clause
!> HINGE: the rotation of q relative to p, with one axis singled out.
module flexact_hinge
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: skew, turned_once, turned_apart
   use flexact_vectors, only: cross
   implicit none
   private
   public :: hinge_deformation, hinge_curvature

contains

   !> e1: angle about the axis in (-pi, pi], the twist that is left when the
   !> shortest rotation has brought the axis of p onto that of q; e2 and e3:
   !> components of the axis of q across that of p, for small rotations the
   !> angles about ey and ez [rad].
   pure subroutine hinge_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      real(wp) :: frame_p(3, 3), frame_q(3, 3), sine, cosine

      e = 0.0_wp
      derivative = 0.0_wp
      frame_p = matmul(p%rotation, reference%frame)
      frame_q = matmul(q%rotation, reference%frame)
      associate (exp => frame_p(:, 1), eyp => frame_p(:, 2), ezp => frame_p(:, 3), &
                 exq => frame_q(:, 1), eyq => frame_q(:, 2), ezq => frame_q(:, 3))
         sine = dot_product(eyq, ezp) - dot_product(ezq, eyp)
         cosine = dot_product(eyq, eyp) + dot_product(ezq, ezp)
         ! Both vanish where the axis has turned right over; no angle then.
         if (abs(sine) + abs(cosine) > 0.0_wp) e(1) = atan2(sine, cosine)
         e(2) = -dot_product(exq, ezp)
         e(3) = dot_product(exq, eyp)
         derivative(1, 10:12) = (exp + exq)/max(1 + dot_product(exp, exq), epsilon(1.0_wp))
         derivative(2, 10:12) = -cross(exq, ezp)
         derivative(3, 10:12) = cross(exq, eyp)
      end associate
      derivative(:, 4:6) = -derivative(:, 10:12)
   end subroutine hinge_deformation

   !> sigma_1 d2e1 + sigma_2 d2e2 + sigma_3 d2e3. With c the axis of q turned by the
   !> spin, e2 and e3 are -xq.zp and xq.yp, together xq.c.
   pure function hinge_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)
      real(wp) :: frame_p(3, 3), exq(3), c(3), own(3, 3), mixed(3, 3)

      frame_p = matmul(p%rotation, reference%frame)
      exq = matmul(q%rotation, reference%frame(:, 1))
      c = sigma(3)*frame_p(:, 2) - sigma(2)*frame_p(:, 3)
      call twist_curvature(frame_p(:, 1), exq, own, mixed)
      own = sigma(1)*own + turned_once(exq, c)
      mixed = sigma(1)*mixed + turned_apart(c, exq)
      h = 0.0_wp
      h(4:6, 4:6) = own
      h(10:12, 10:12) = own
      h(4:6, 10:12) = mixed
      h(10:12, 4:6) = transpose(mixed)
   end function hinge_curvature

   !> Second derivatives of the twist e1: `own` with respect to either spin, `mixed`
   !> to that of p (rows) and that of q (columns). Its first derivative with respect to
   !> the spin of q is t = (xp + xq)/(1 + xp.xq), to that of p -t.
   pure subroutine twist_curvature(xp, xq, own, mixed)
      real(wp), intent(in) :: xp(3), xq(3)
      real(wp), intent(out) :: own(3, 3), mixed(3, 3)
      real(wp) :: t(3), k(3), both
      integer :: i

      both = max(1 + dot_product(xp, xq), epsilon(1.0_wp))
      t = (xp + xq)/both
      k = cross(xp, xq)/both
      do i = 1, 3
         own(:, i) = (t*k(i) + k*t(i))/2
         mixed(:, i) = -t*k(i)
      end do
      mixed = mixed + skew(xq)/both
   end subroutine twist_curvature
end module flexact_hinge
