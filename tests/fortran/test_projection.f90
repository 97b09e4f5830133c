! SPDX-License-Identifier: BSD-3-Clause
!> Z'A Z by blocks against products of dense matrices.
program test_projection
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_projection, only: project
   use flexact_projection_pattern, only: projection_t, prepare
   use flexact_row_space, only: row_space_t, analyse_rows
   use flexact_sparse, only: sparse_t
   use flexact_test_matrices, only: sparse_of, dense_of
   use flexact_testing, only: tally_t, set_random
   implicit none
   integer, parameter :: n = 30
   type(tally_t) :: tally
   type(projection_t) :: projection
   integer :: rows

   call set_random()
   ! Again with the same pattern, and then with another.
   do rows = 3, 1, -1
      call compare(rows)
      call compare(rows)
   end do
   call compare(0)
   call tally%finish()

contains

   !> Null vectors of some rows in two components, beside columns that are free.
   subroutine compare(rows)
      integer, intent(in) :: rows
      real(wp) :: j(2*rows, n), a(n, n), z(n, n), low(n, n), noise(n, n)
      type(row_space_t) :: space
      type(sparse_t) :: matrix
      type(error_t), allocatable :: error
      integer :: i, k, motions

      call random_number(noise)
      a = 0.0_wp
      do i = 1, n
         do k = max(1, i - 3), min(n, i + 3)
            a(i, k) = noise(i, k) + noise(k, i)
         end do
      end do
      call random_number(noise)
      j = 0.0_wp
      j(:rows, 4:9) = noise(:rows, 4:9)
      j(rows + 1:, 7 + 4:20:2) = noise(rows + 1:2*rows, 7 + 4:20:2)
      call analyse_rows(sparse_of(j), space, error)
      motions = n - 2*rows
      call tally%check(space%basis%columns == motions, 'as many motions as rows leave')
      call prepare(space%basis, sparse_of(a), projection)
      call project(projection, sparse_of(a), matrix)
      z(:, :motions) = dense_of(space%basis)
      low(:motions, :motions) = matmul(transpose(z(:, :motions)), matmul(a, z(:, :motions)))
      do i = 1, motions
         low(:i - 1, i) = 0.0_wp
      end do
      call tally%near([dense_of(matrix)], [low(:motions, :motions)], 1.0e-13_wp, 'the lower triangle')
   end subroutine compare
end program test_projection
