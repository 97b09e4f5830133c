! SPDX-License-Identifier: BSD-3-Clause
!> Our Cholesky factor beside CHOLMOD's (Chen, Davis, Hager, Rajamanickam, ACM Trans. Math. Softw.
!> 35, 2008), on random matrices of the kind that the method sparse factorises: A'A with ones at
!> pinned columns, less t**2 or more, of sparse A that are regular, singular, nearly so or graded.
!> Where rounding could make them differ is bounded by the error that both own up to.
!>
!> Usage: test_second_opinion [how many]
program test_second_opinion
   use, intrinsic :: iso_c_binding, only: c_ptr, c_associated
   use, intrinsic :: iso_fortran_env, only: error_unit
   use flexact_backward_error, only: error_of_gram, unit, extra
   use flexact_cholesky_error, only: error_of_cholesky
   use flexact_cholesky, only: cholesky_t, get_pivots
   use flexact_cholesky_oracle, only: lower_t, analyse_for, factorise_by, entries_of, fill_of, permuted, failing, &
                                      failing_t
   use flexact_cholmod, only: cholmod_analyse, cholmod_factor, cholmod_pivots, cholmod_error, cholmod_solve, cholmod_free
   use flexact_error, only: error_t
   use flexact_gram, only: gram_t, make_gram
   use flexact_kinds, only: wp
   use flexact_lapack, only: dtrsm
   use flexact_sparse, only: operator_t, operator_of
   use flexact_supernodal_solve, only: solve
   use flexact_test_matrices, only: identity, sparse_of
   use flexact_testing, only: tally_t, set_random
   implicit none

   !> Bounds may differ by so much, as CHOLMOD pads other supernodes.
   real(wp), parameter :: apart = 4.0_wp
   !> What became of the matrices.
   type :: met_t
      integer :: definite = 0, failed = 0, elsewhere = 0, in_doubt = 0, compared = 0
   end type met_t

   type(tally_t) :: tally
   type(met_t) :: met
   character(len=16) :: word
   integer :: matrices, k, status

   matrices = 80
   call get_command_argument(1, word)
   if (len_trim(word) > 0) read (word, *, iostat=status) matrices
   call set_random()
   do k = 1, matrices
      call a_matrix(k)
   end do
   write (*, '(5(i0, a))') met%definite, ' definite by both; ', met%failed, ' failed by both, ', met%elsewhere, &
      ' of them at other columns that fail as well; ', met%in_doubt, ' within rounding; ', met%compared, ' columns compared'
   call tally%check(met%definite > matrices/5 .and. met%failed > matrices/5, 'both kinds are met')
   call tally%finish()

contains

   real(wp) function drawn()
      call random_number(drawn)
   end function drawn

   !> A, of which some columns depend on others, entirely or nearly, shifted and pinned in turn, and
   !> as it is.
   subroutine a_matrix(k)
      integer, intent(in) :: k
      real(wp), allocatable :: dense(:, :)
      type(operator_t) :: a
      type(gram_t) :: gram
      type(lower_t) :: lower
      real(wp) :: bytes, largest, square
      real(wp), allocatable :: added(:)
      integer, allocatable :: order(:), special(:)
      integer :: n, turn

      n = 12 + int(12*drawn()*merge(22.0_wp, 4.0_wp, modulo(k, 4) == 0))
      dense = random_matrix(n, special, modulo(k, 5))
      a = operator_of(sparse_of(dense))
      call make_gram(a, huge(bytes), gram, bytes)
      largest = maxval(gram%value(gram%diagonal))
      square = max(1.0e-13_wp*largest, 1.5_wp*error_of_gram(a, largest, 0.0_wp))
      allocate (added(n))
      order = some_order(n, modulo(k, 3))
      lower = lower_t(n, gram%start, gram%place, gram%value)
      do turn = 1, 5
         added = merge(1.0_wp, merge(0.0_wp, -1.0_wp, turn == 5), turn == 1)*square
         if (turn == 3 .or. turn == 4) added(special) = added(special) + 1.0_wp
         if (turn == 4) added(special(1)) = added(special(1)) - 1.0_wp
         lower%value = gram%value
         lower%value(gram%diagonal) = lower%value(gram%diagonal) + added
         call compare(lower, order, 1 + modulo(k, 2))
      end do
   end subroutine a_matrix

   !> Columns as they come, backwards, or drawn; from 0.
   function some_order(n, kind) result(order)
      integer, intent(in) :: n, kind
      integer :: order(n), i, k, kept

      order = [(merge(n - i, i - 1, kind == 1), i=1, n)]
      if (kind < 2) return
      do i = n, 2, -1
         k = 1 + int(i*drawn())
         kept = order(k)
         order(k) = order(i)
         order(i) = kept
      end do
   end function some_order

   !> Few entries a row. special: columns that depend on others. kind 0: entirely; 1: but for
   !> 1e-9 to 1e-3; 2: columns of lengths 1e-3 to 1e3; others as they are drawn.
   function random_matrix(n, special, kind) result(dense)
      integer, intent(in) :: n, kind
      integer, allocatable, intent(out) :: special(:)
      real(wp), allocatable :: dense(:, :)
      integer :: i, j, c, rows

      rows = n + int(0.4_wp*n*drawn())
      allocate (dense(rows, n), source=0.0_wp)
      do i = 1, rows
         do c = 1, 2 + int(4*drawn())
            j = 1 + modulo(i + int(merge(6.0_wp, real(n, wp), drawn() < 0.8_wp)*drawn()), n)
            dense(i, j) = 2*drawn() - 1
         end do
      end do
      special = [(1 + int(n*drawn()), c=1, 1 + int(5*drawn()))]
      special = pack(special, [(all(special(:c - 1) /= special(c)), c=1, size(special))])
      if (kind > 2) return
      do c = 1, size(special)
         j = special(c)
         associate (x => 1 + modulo(j, n), y => 1 + modulo(j + 6, n))
            if (kind < 2) dense(:, j) = merge(0.0_wp, 10.0_wp**(-3 - 6*drawn()), kind == 0)*dense(:, j) &
                                        - dense(:, x) + 2*dense(:, y)
         end associate
      end do
      if (kind < 2) return
      do j = 1, n
         dense(:, j) = dense(:, j)*10.0_wp**(6*drawn() - 3)
      end do
   end function random_matrix

   subroutine compare(lower, order, threads)
      type(lower_t), intent(in) :: lower
      integer, intent(in) :: order(:), threads
      type(cholesky_t) :: factor
      type(c_ptr) :: handle
      type(error_t), allocatable :: error
      real(wp) :: entries
      integer :: widest, own, other

      call analyse_for(threads, lower, order, factor, error)
      if (.not. allocated(error)) call factorise_by(threads, factor, lower%value, own, error)
      call tally%check(.not. allocated(error), 'no error')
      handle = cholmod_analyse(lower%n, lower%start, lower%place, order, entries, widest)
      call tally%check(c_associated(handle), 'CHOLMOD has room')
      other = cholmod_factor(handle, lower%n, lower%start, lower%place, lower%value)
      call tally%check(factor%entries >= entries .and. factor%widest >= widest, 'room for what CHOLMOD counts')
      if (own == 0 .and. other == 0) then
         met%definite = met%definite + 1
         call compare_factors(lower, factor, handle)
      else
         call compare_failures(lower, factor, own, other)
      end if
      call cholmod_free(handle)
   end subroutine compare

   !> In full; the lower triangle counts.
   pure function full(a) result(dense)
      type(lower_t), intent(in) :: a
      real(wp) :: dense(a%n, a%n)
      integer :: j, e

      dense = 0.0_wp
      do j = 1, a%n
         do e = a%start(j) + 1, a%start(j + 1)
            dense(a%place(e) + 1, j) = a%value(e)
            dense(j, a%place(e) + 1) = a%value(e)
         end do
      end do
   end function full

   !> The column that is told is one at which elimination may fail: its leading part is not clearly
   !> definite, and none before it that it depends on clearly fails.
   subroutine compare_failures(lower, factor, own, other)
      type(lower_t), intent(in) :: lower
      type(cholesky_t), intent(in) :: factor
      integer, intent(in) :: own, other
      real(wp) :: dense(lower%n, lower%n), margin
      logical :: fill(lower%n, lower%n)
      type(failing_t) :: above, below

      dense = permuted(full(lower), factor%pattern%order)
      fill = fill_of(abs(dense) > 0)
      margin = 8*real(lower%n, wp)*(lower%n + 4)*unit
      above = failing(dense, fill, margin)
      below = failing(dense, fill, -margin)
      if (own == 0 .or. other == 0) then
         met%in_doubt = met%in_doubt + 1
         call tally%check(.not. any(above%fails), 'one fails, the other does not: not clearly')
         return
      end if
      met%failed = met%failed + 1
      if (own /= other) met%elsewhere = met%elsewhere + 1
      call tally%check(may_fail(own, factor, above, below), 'where ours fails')
      call tally%check(may_fail(other, factor, above, below), 'where CHOLMOD fails')
   end subroutine compare_failures

   !> above, below: where elimination fails with a little more on the diagonal, and with less.
   logical function may_fail(column, factor, above, below)
      integer, intent(in) :: column
      type(cholesky_t), intent(in) :: factor
      type(failing_t), intent(in) :: above, below
      integer :: p

      p = findloc(factor%pattern%order, column, 1)
      may_fail = .not. above%is_lost(p) .and. (below%fails(p) .or. below%is_lost(p))
   end function may_fail

   !> Two factors, each off by no more than its bound: so far may pivots and solutions be apart.
   !> Of pivot j, relative: what A is off by times the square of row j of the inverse of L.
   subroutine compare_factors(lower, factor, handle)
      type(lower_t), intent(in) :: lower
      type(cholesky_t), intent(in) :: factor
      type(c_ptr), intent(in) :: handle
      real(wp) :: l(lower%n, lower%n), inverse(lower%n, lower%n), ours(lower%n), theirs(lower%n), spread_of(lower%n)
      real(wp) :: own, other
      integer :: order(lower%n)

      own = error_of_cholesky(factor, 0.0_wp)
      other = cholmod_error(handle, unit, extra, 0.0_wp)
      call tally%check(own < apart*other .and. other < apart*own, 'bounds of the error')
      call entries_of(factor, l, order)
      inverse = identity(lower%n)
      call dtrsm('L', 'L', 'N', 'N', lower%n, lower%n, 1.0_wp, l, lower%n, inverse, lower%n)
      call get_pivots(factor, ours)
      call cholmod_pivots(handle, theirs)
      spread_of(order) = 2*(own + other)*sum(inverse**2, 2) + 8*unit
      met%compared = met%compared + count(spread_of < 0.1_wp)
      call tally%check(all(abs(ours - theirs) <= spread_of*(1 + spread_of)*min(ours, theirs) .or. spread_of > 0.1_wp), 'pivots')
      call compare_solutions(lower, factor, handle, own, other, 2*(own + other)*sum(inverse**2))
   end subroutine compare_factors

   !> amplified: how far solutions may be apart, relative.
   subroutine compare_solutions(lower, factor, handle, own, other, amplified)
      type(lower_t), intent(in) :: lower
      type(cholesky_t), intent(in) :: factor
      type(c_ptr), intent(in) :: handle
      real(wp), intent(in) :: own, other, amplified
      integer, parameter :: sides = 3
      real(wp) :: b(lower%n, sides), ours(lower%n, sides), theirs(lower%n, sides), a(lower%n, lower%n)
      type(error_t), allocatable :: error

      call random_number(b)
      ours = b
      call solve(factor, ours, error)
      call tally%check(.not. allocated(error), 'solved')
      call tally%check(cholmod_solve(handle, lower%n, sides, b, theirs) == 0, 'solved by CHOLMOD')
      a = full(lower)
      call tally%check(norm2(matmul(a, ours) - b) <= 6*own*norm2(ours) + 100*unit*norm2(b), 'residual')
      call tally%check(norm2(matmul(a, theirs) - b) <= 6*other*norm2(theirs) + 100*unit*norm2(b), 'residual of CHOLMOD''s')
      if (amplified > 0.1_wp) return
      call tally%check(norm2(ours - theirs) <= 4*amplified*norm2(theirs), 'solutions')
   end subroutine compare_solutions
end program test_second_opinion
