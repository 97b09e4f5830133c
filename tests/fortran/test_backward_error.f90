! SPDX-License-Identifier: BSD-3-Clause
!> Bounds of the rounding of A'A and of its factorisations, against the errors
!> themselves in quadruple precision.
program test_backward_error
   use flexact_backward_error, only: error_of_gram
   use flexact_cholesky_oracle, only: entries_of
   use flexact_error, only: error_t
   use flexact_factor, only: factor_t, analyse, factorise, error_of_factor
   use flexact_gram, only: gram_t, make_gram
   use flexact_kinds, only: wp
   use flexact_pinned, only: pinned_t, make_pinned, release
   use flexact_progress, only: progress_t
   use flexact_sparse, only: operator_t, operator_of
   use flexact_test_matrices, only: sparse_of, grid, path
   use flexact_testing, only: tally_t, set_random
   implicit none
   integer, parameter :: qp = selected_real_kind(30)
   type(tally_t) :: tally

   call set_random()
   call a_gram_matrix(40, 30)
   call a_gram_matrix(3000, 3)
   call a_gram_matrix(3, 50)
   call a_factor(60, 40)
   call a_factor(400, 150)
   call a_path()
   call of_nothing()
   call a_grid(15)
   call a_grid(120)
   call tally%finish()

contains

   function random_matrix(m, n) result(dense)
      integer, intent(in) :: m, n
      real(wp) :: dense(m, n), chance(m, n)

      call random_number(dense)
      call random_number(chance)
      dense = merge(dense - 0.3_wp, 0.0_wp, chance < 0.5_wp)
   end function random_matrix

   !> The error is below its bound, which is no more than n times as large as the
   !> largest sums of magnitudes are off by.
   subroutine a_gram_matrix(m, n)
      integer, intent(in) :: m, n
      real(wp) :: dense(m, n), bound, made(n, n)
      type(operator_t) :: a
      type(gram_t) :: gram
      real(wp) :: bytes
      integer :: j, entry

      dense = random_matrix(m, n)
      a = operator_of(sparse_of(dense))
      call make_gram(a, huge(bytes), gram, bytes)
      made = 0.0_wp
      do j = 1, n
         do entry = gram%start(j) + 1, gram%start(j + 1)
            made(gram%place(entry) + 1, j) = gram%value(entry)
            made(j, gram%place(entry) + 1) = gram%value(entry)
         end do
      end do
      bound = error_of_gram(a, maxval(sum(dense**2, 1)), 0.0_wp)
      call tally%check(off_by(made, matmul(transpose(real(dense, qp)), real(dense, qp))) <= bound, 'A''A: within the bound')
      call tally%check(bound <= epsilon(bound)*(m + 4)*sum(dense**2) + 5*epsilon(bound), 'A''A: which is no larger than need be')
   end subroutine a_gram_matrix

   !> The 2-norm is no more than this.
   real(wp) function off_by(made, exact)
      real(wp), intent(in) :: made(:, :)
      real(qp), intent(in) :: exact(:, :)
      off_by = sqrt(real(sum((made - exact)**2), wp))
   end function off_by

   !> A'A - shift I, in the order of its columns.
   subroutine factorise_gram(a, shift, factor)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: shift
      type(factor_t), intent(out) :: factor
      type(gram_t) :: gram
      type(error_t), allocatable :: error
      real(wp) :: bytes
      integer :: failed, j

      call make_gram(a, huge(bytes), gram, bytes)
      gram%value(gram%diagonal) = gram%value(gram%diagonal) - shift
      call analyse(gram%start, gram%place, [(j, j=0, a%by_column%columns - 1)], 1, factor, error)
      call factorise(factor, gram%value, progress_t(), failed, error)
      call tally%check(.not. allocated(error), 'factor: definite')
   end subroutine factorise_gram

   subroutine a_factor(m, n)
      integer, intent(in) :: m, n
      real(wp) :: dense(m, n), l(n, n), bound
      type(operator_t) :: a
      type(factor_t) :: factor
      integer :: order(n), i
      real(qp) :: exact(n, n), turned(m, n)

      dense = random_matrix(m, n)
      a = operator_of(sparse_of(dense))
      call factorise_gram(a, 1.0e-3_wp, factor)
      call entries_of(factor, l, order)
      turned = dense(:, order)
      exact = matmul(transpose(turned), turned)
      do i = 1, n
         exact(i, i) = exact(i, i) - 1.0e-3_wp
      end do
      bound = error_of_factor(factor, 0.0_wp) + error_of_gram(a, maxval(sum(dense**2, 1)), 0.0_wp)
      call tally%check(sqrt(real(sum((matmul(real(l, qp), real(transpose(l), qp)) - exact)**2), wp)) <= bound, &
                       'factor: within the bound')
      call tally%check(error_of_factor(factor, 0.0_wp) <= epsilon(bound)*(n + 4)*sum(l**2), 'factor: no larger than need be')
   end subroutine a_factor

   !> Rows of the factor have two entries each: the bound does not grow with the size.
   subroutine a_path()
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error
      integer, parameter :: n = 20000
      integer :: j

      call make_pinned(operator_of(path(n, .false.)), [(j, j=1, n)], huge(1.0_wp), progress_t(), pinned, error)
      call tally%check(.not. allocated(error), 'path: pinned')
      call tally%check(pinned%rounding > 0 .and. pinned%rounding < 60*epsilon(1.0_wp), 'path: a few roundings')
      call tally%check(pinned%bound > 0.9_wp*pinned%least .and. pinned%bound < pinned%least, 'path: nearly t')
   end subroutine a_path

   !> A matrix without entries has no error but that of what is added.
   subroutine of_nothing()
      real(wp) :: zero(2, 3)

      zero = 0.0_wp
      call tally%check(error_of_gram(operator_of(sparse_of(zero)), 1.0_wp, 0.0_wp) <= 10*epsilon(1.0_wp), 'nothing')
   end subroutine of_nothing

   !> What the factor tells agrees with what one along the rows of the grid does as far as the
   !> order of elimination lets it; t stands above it.
   subroutine a_grid(n)
      integer, intent(in) :: n
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(factor_t) :: along
      type(error_t), allocatable :: error
      real(wp) :: other
      integer :: j

      a = operator_of(grid(n, .false.))
      call make_pinned(a, [(j, j=1, n**2)], huge(1.0_wp), progress_t(), pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 0, 'grid: definite')
      call tally%check(pinned%bound > 0.3_wp*pinned%least .and. pinned%bound < pinned%least, 'grid: shown up to nearly t')
      call factorise_gram(a, 0.0_wp, along)
      other = error_of_factor(along, 0.0_wp)
      call tally%check(error_of_factor(pinned%factor, 0.0_wp) < 5*other, 'grid: as along its rows')
      call tally%check(error_of_factor(pinned%factor, 0.0_wp) > 0.02_wp*other, 'grid: and not far below')
      call release(pinned)
   end subroutine a_grid
end program test_backward_error
