! SPDX-License-Identifier: BSD-3-Clause
!> Sparse vectors that span what is orthogonal to a few others, and the decompositions
!> that need them: those of long matrices without a square of the longer side.
program test_complement
   use flexact_complement, only: add_complement
   use flexact_decomposition, only: method_svd, method_jacobi, decompose_by
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   use flexact_test_matrices, only: identity, dense_of
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call of_a_long_matrix(method_svd, 700, 5)
   call of_a_long_matrix(method_jacobi, 700, 5)
   call of_a_long_matrix(method_svd, 2, 1)
   call of_equal_rows()
   call of_nothing()
   call tally%finish()

contains

   !> A thin U, and what is orthogonal to it; its vectors are independent, as each
   !> has a one where the others have none.
   subroutine of_a_long_matrix(method, m, n)
      integer, intent(in) :: method, m, n
      real(wp) :: a(m, n), copy(m, n), values(n), u(m, n), vt(n, n), vectors(m, m - n)
      type(sparse_basis_t) :: basis
      type(error_t), allocatable :: error

      call random_number(a)
      copy = a
      call decompose_by(method, copy, values, u, vt, error)
      call tally%check(.not. allocated(error), 'thin: status')
      call tally%near([matmul(u*spread(values, 1, m), vt)], [a], 1.0e-12_wp, 'thin: product of the factors')
      call tally%near([matmul(transpose(u), u)], [identity(n)], 1.0e-13_wp, 'thin: U')
      call new_sparse_basis(basis)
      call add_complement(u, basis, error)
      call tally%check(.not. allocated(error) .and. basis%vectors == m - n, 'complement: as many as there are')
      call tally%check(basis%entries() <= (m - n)*(n + 1), 'complement: sparse')
      vectors = dense_of(basis%as_matrix(m))
      call tally%check(all(abs(matmul(transpose(a), vectors)) <= 1.0e-11_wp), 'complement: no image')
      call tally%check(count(count(abs(vectors) > 0, 2) == 1) >= m - n - 1, 'complement: independent')
   end subroutine of_a_long_matrix

   !> As of bars between two nodes: differences of two rows each.
   subroutine of_equal_rows()
      integer, parameter :: m = 300
      type(sparse_basis_t) :: basis
      type(error_t), allocatable :: error

      call new_sparse_basis(basis)
      call add_complement(spread([1/sqrt(real(m, wp))], 1, m), basis, error)
      call tally%check(basis%vectors == m - 1 .and. basis%entries() == 2*(m - 1), 'equal rows: differences')
      call tally%near([sum(basis%value(:basis%entries()))], [0.0_wp], 1.0e-11_wp, 'equal rows: which add up to nothing')
   end subroutine of_equal_rows

   subroutine of_nothing()
      real(wp) :: none(4, 0)
      type(sparse_basis_t) :: basis
      type(error_t), allocatable :: error

      call new_sparse_basis(basis)
      call add_complement(none, basis, error)
      call tally%check(basis%vectors == 4 .and. all(basis%place(:4) == [1, 2, 3, 4]), 'nothing: all axes')
   end subroutine of_nothing
end program test_complement
