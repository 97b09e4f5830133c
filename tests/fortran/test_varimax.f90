! SPDX-License-Identifier: BSD-3-Clause
!> A readable basis: the same space, still orthonormal, few large parts.
program test_varimax
   use flexact_kinds, only: wp
   use flexact_varimax, only: varimax
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call separate_motions_are_found()
   call space_is_kept()
   call scale_is_heeded()
   call empty_and_single()
   call tally%finish()

contains

   !> Three vectors on separate entries, mixed by rotations: the answer is known.
   subroutine separate_motions_are_found()
      real(wp), parameter :: h = sqrt(0.5_wp)
      real(wp) :: known(7, 3), basis(7, 3)

      known = 0.0_wp
      known([1, 2], 1) = [h, h]
      known([3, 5], 2) = [h, -h]
      known([6, 7], 3) = [0.6_wp, 0.8_wp]
      basis = matmul(known, random_rotation())
      call varimax(basis, spread(1.0_wp, 1, 7))
      call tally%near(reshape(basis, [21]), reshape(known, [21]), 1.0e-12_wp, 'mixed motions come apart')
   end subroutine separate_motions_are_found

   subroutine space_is_kept()
      real(wp) :: basis(9, 3), before(9, 9), identity(3, 3)

      call random_basis(basis)
      before = matmul(basis, transpose(basis))
      call varimax(basis, spread(1.0_wp, 1, 9))
      call tally%near(reshape(matmul(basis, transpose(basis)), [81]), reshape(before, [81]), 1.0e-14_wp, 'one space')
      identity = 0.0_wp
      identity(1, 1) = 1.0_wp
      identity(2, 2) = 1.0_wp
      identity(3, 3) = 1.0_wp
      call tally%near(reshape(matmul(transpose(basis), basis), [9]), reshape(identity, [9]), 1.0e-14_wp, 'orthonormal')
   end subroutine space_is_kept

   !> A change of unit, which scale undoes, changes the result by as much.
   subroutine scale_is_heeded()
      real(wp) :: basis(9, 2), other(9, 2), unit(9)

      call random_basis(basis)
      unit = 1.0_wp
      unit(4:6) = 1.0e-3_wp
      other = basis*spread(unit, 2, 2)
      call varimax(basis, spread(1.0_wp, 1, 9))
      call varimax(other, unit)
      call tally%near(reshape(other/spread(unit, 2, 2), [18]), reshape(basis, [18]), 1.0e-9_wp, 'scaled entries decide')
   end subroutine scale_is_heeded

   subroutine empty_and_single()
      real(wp) :: none(4, 0), empty(0, 0), single(3, 1)

      call varimax(none, spread(1.0_wp, 1, 4))
      call varimax(empty, spread(1.0_wp, 1, 0))
      single(:, 1) = [0.5_wp, -0.8_wp, 0.1_wp]
      call varimax(single, spread(1.0_wp, 1, 3))
      call tally%near(single(:, 1), [-0.5_wp, 0.8_wp, -0.1_wp], 0.0_wp, 'the largest part is positive')
   end subroutine empty_and_single

   function random_rotation() result(rotation)
      real(wp) :: rotation(3, 3)
      call random_basis(rotation)
   end function random_rotation

   !> Orthonormal columns by Gram and Schmidt, twice.
   subroutine random_basis(basis)
      real(wp), intent(out) :: basis(:, :)
      integer :: i, j, pass

      call random_number(basis)
      basis = basis - 0.5_wp
      do pass = 1, 2
         do i = 1, size(basis, 2)
            do j = 1, i - 1
               basis(:, i) = basis(:, i) - dot_product(basis(:, j), basis(:, i))*basis(:, j)
            end do
            basis(:, i) = basis(:, i)/norm2(basis(:, i))
         end do
      end do
   end subroutine random_basis
end program test_varimax
