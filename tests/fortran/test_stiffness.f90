! SPDX-License-Identifier: BSD-3-Clause
!> Stiffness matrices of elements against closed forms, and of notches in series.
program test_stiffness
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
   use flexact_element_stiffness, only: element_stiffness, torsion_elongation
   use flexact_element_table, only: element_kinds, find_element_kind, deformations_of, member_link
   use flexact_kinds, only: wp
   use flexact_testing, only: tally_t, set_random
   implicit none

   type(tally_t) :: tally
   real(wp) :: none(6)
   real(wp), parameter :: l = 0.5_wp, numbers(6) = [7.0_wp, 5.0_wp, 3.0_wp, 2.0_wp, 0.04_wp, 0.09_wp]

   call set_random()
   none = ieee_value(1.0_wp, ieee_quiet_nan)
   call test_every_kind()
   call test_beam()
   call test_clamped_sheet()
   call test_hinges()
   call test_notches()
   call test_torsion_elongation()
   call tally%finish()

contains

   function stiffness_of(keyword, given, notch) result(s)
      character(len=*), intent(in) :: keyword
      real(wp), intent(in) :: given(6), notch(6)
      real(wp) :: s(6, 6)
      call element_stiffness(find_element_kind(keyword), l, given, notch, s)
   end function stiffness_of

   subroutine same(s, expected, tolerance, name)
      real(wp), intent(in) :: s(6, 6), expected(6, 6), tolerance
      character(len=*), intent(in) :: name
      call tally%near(reshape(s, [36]), reshape(expected, [36]), tolerance, name)
   end subroutine same

   !> A stiffness for each deformation but those of rigid bodies; symmetric, positive
   !> definite, nothing without numbers. An entry of the table that is forgotten in the
   !> rule of its roles has none.
   subroutine test_every_kind()
      real(wp) :: s(6, 6), e(6)
      integer :: kind, k, trial

      do kind = 1, size(element_kinds)
         associate (name => element_kinds(kind)%keyword, count => deformations_of(kind))
            call element_stiffness(kind, l, none, none, s)
            call same(s, 0*s, 0.0_wp, 'no numbers, no stiffness: '//name)
            call element_stiffness(kind, l, numbers, none, s)
            call same(s, transpose(s), 0.0_wp, 'symmetric stiffness of '//name)
            do k = 1, 6
               call tally%check((s(k, k) > 0.0_wp) .eqv. (k <= count .and. element_kinds(kind)%member /= member_link), &
                                'each deformation has a stiffness: '//name)
            end do
            do trial = 1, 10
               call random_number(e)
               e = 2*e - 1
               call tally%check(dot_product(e, matmul(s, e)) >= 0.0_wp, 'no negative energy of '//name)
            end do
         end associate
      end do
   end subroutine test_every_kind

   !> Without shear and with it, in both planes, and the planar beam in its own.
   subroutine test_beam()
      real(wp) :: s(6, 6), expected(6, 6), given(6)
      real(wp), parameter :: p(2) = 12*[0.04_wp, 0.09_wp]/l**2

      given = none
      given(1:4) = numbers(1:4)
      expected = 0.0_wp
      expected(1, 1) = 7/l
      expected(2, 2) = 5/l**3
      expected(3:4, 3:4) = 3/l**3*reshape([4, -2, -2, 4], [2, 2])
      expected(5:6, 5:6) = 2/l**3*reshape([4, -2, -2, 4], [2, 2])
      call same(stiffness_of('BEAM', given, none), expected, 1.0e-13_wp, 'a slender beam')
      expected(3:4, 3:4) = 3/(1 + p(1))/l**3*reshape([4 + p(1), -2 + p(1), -2 + p(1), 4 + p(1)], [2, 2])
      expected(5:6, 5:6) = 2/(1 + p(2))/l**3*reshape([4 + p(2), -2 + p(2), -2 + p(2), 4 + p(2)], [2, 2])
      call same(stiffness_of('BEAM', numbers, none), expected, 1.0e-13_wp, 'a beam with shear')

      s = stiffness_of('PLBEAM', [7.0_wp, 3.0_wp, 0.04_wp, none(4:6)], none)
      call tally%near(reshape(s(1:3, 1:3), [9]), [7/l, 0.0_wp, 0.0_wp, 0.0_wp, expected(3:4, 3), 0.0_wp, expected(3:4, 4)], &
                      1.0e-13_wp, 'a planar beam with shear')
   end subroutine test_beam

   !> The compliance of a cantilever's end, by the modes of eq. (4): a displacement w in z
   !> and a turn t about y give e3 = -w, e4 = w - l0 t. By a force L^3/3EI + L/GAk, by a
   !> moment L/EI.
   subroutine test_clamped_sheet()
      real(wp) :: s(6, 6), modes(2, 2), k(2, 2), c(2, 2)
      real(wp), parameter :: ei = 3.0_wp, shear = 0.04_wp

      s = stiffness_of('BEAM', numbers, none)
      modes = reshape([-1.0_wp, 1.0_wp, 0.0_wp, -l], [2, 2])
      k = matmul(transpose(modes), matmul(s(3:4, 3:4), modes))
      c = reshape([k(2, 2), -k(2, 1), -k(1, 2), k(1, 1)], [2, 2])/(k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1))
      call tally%near([c(1, 1), c(2, 2)], [l**3/(3*ei) + l*shear/ei, l/ei], 1.0e-14_wp, 'compliance of a cantilever')
   end subroutine test_clamped_sheet

   subroutine test_hinges()
      real(wp) :: expected(6, 6)
      integer :: k

      expected = 0.0_wp
      do k = 1, 6
         expected(k, k) = numbers(k)
         if (k == 1) call same(stiffness_of('PLHINGE', numbers, none), expected, 0.0_wp, 'a planar hinge')
         if (k == 3) call same(stiffness_of('HINGE', numbers, none), expected, 0.0_wp, 'a hinge')
      end do
      call same(stiffness_of('BEARING', numbers, none), expected, 0.0_wp, 'a bearing')
   end subroutine test_hinges

   !> Against S - S_R (S_RR + K)^-1 S_R' with all releases at once.
   subroutine test_notches()
      real(wp) :: s(6, 6), at_once(6, 6), notch(6), k(2, 2), inverse(2, 2)

      s = stiffness_of('BEAM', numbers, none)
      notch = none
      notch(3:4) = [2.0_wp, 11.0_wp]
      k = s(3:4, 3:4)
      k(1, 1) = k(1, 1) + 2
      k(2, 2) = k(2, 2) + 11
      inverse = reshape([k(2, 2), -k(2, 1), -k(1, 2), k(1, 1)], [2, 2])/(k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1))
      at_once = s - matmul(s(:, 3:4), matmul(inverse, s(3:4, :)))
      call same(stiffness_of('BEAM', numbers, notch), at_once, 1.0e-12_wp, 'two notches in one plane')

      notch(3:4) = 0.0_wp
      at_once = s
      at_once(3:4, :) = 0.0_wp
      at_once(:, 3:4) = 0.0_wp
      call same(stiffness_of('BEAM', numbers, notch), at_once, 0.0_wp, 'both ends of a plane without stress')
      notch = 0.0_wp
      call same(stiffness_of('BEAM', numbers, notch), 0*s, 0.0_wp, 'nothing left')
      call same(stiffness_of('RBEAM', numbers, notch), 0*s, 0.0_wp, 'a notch where there is no stiffness')

      ! One end on a pin, without shear: 3 EI/L^3.
      notch = none
      notch(5) = 0.0_wp
      at_once = stiffness_of('BEAM', [numbers(1:4), none(5:6)], notch)
      call tally%near([at_once(5, 5), at_once(5, 6), at_once(6, 6)], [0.0_wp, 0.0_wp, 3*2/l**3], 1.0e-13_wp, 'a pin')
      notch(5) = ieee_value(1.0_wp, ieee_positive_inf)
      call same(stiffness_of('BEAM', numbers, notch), s, 0.0_wp, 'a notch that does not give way')
      ! Two springs in series.
      notch = none
      notch(1) = 6.0_wp
      at_once = stiffness_of('BEAM', numbers, notch)
      call tally%near(at_once(1:1, 1), [1/(l/7 + 1/6.0_wp)], 1.0e-14_wp, 'springs in series')
   end subroutine test_notches

   subroutine test_torsion_elongation()
      real(wp) :: halves(6), wide(6)
      integer :: beam

      beam = find_element_kind('BEAM')
      call tally%near([torsion_elongation(beam, l, numbers, [2.0_wp, 8.0_wp, none(3:5)]), &
                       torsion_elongation(beam, l, none, [2.0_wp, 8.0_wp, none(3:5)]), &
                       torsion_elongation(beam, l, 0*numbers, [2.0_wp, none(2:5)]), &
                       torsion_elongation(beam, l, none, none(1:5)), &
                       torsion_elongation(find_element_kind('PLBEAM'), l, numbers, numbers(1:5))], &
                      [5/7.0_wp, 4.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, 'coupling of torsion and elongation')
      ! A half of a notch, stiff in both bendings, has no section; a wide sheet shears one way alone.
      halves = [numbers(:4), 10*l**2 + 1, 10*l**2 + 1]
      wide = [numbers(:4), 10*l**2 + 1, 0.09_wp]
      call tally%near([torsion_elongation(beam, l, halves, [2.0_wp, 8.0_wp, none(3:5)]), &
                       torsion_elongation(beam, l, halves, none(1:5)), &
                       torsion_elongation(beam, l, wide, none(1:5))], &
                      [4.0_wp, 0.0_wp, 5/7.0_wp], 1.0e-15_wp, 'coupling of what stays straight')
   end subroutine test_torsion_elongation
end program test_stiffness
