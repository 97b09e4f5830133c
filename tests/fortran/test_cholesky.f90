! SPDX-License-Identifier: BSD-3-Clause
!> The supernodal Cholesky factor against dense elimination: where it has entries, its residual
!> in quadruple precision, where it fails, its pivots, solutions and the bound of its error.
program test_cholesky
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf, ieee_negative_inf
   use flexact_cholesky_error, only: error_of_cholesky
   use flexact_cholesky, only: cholesky_t, get_pivots
   use flexact_cholesky_oracle, only: lower_t, lower_of, analyse_for, factorise_by, entries_of, fill_of, permuted, &
                                      failing, failing_t, largest_residual, nested_grid, bound_of_full
   use flexact_error, only: error_t, is_kind, error_memory, error_interrupted
   use flexact_kinds, only: wp, qp
   use flexact_multifrontal, only: factorise
   use flexact_progress, only: progress_t
   use flexact_supernodal_solve, only: solve
   use flexact_testing, only: tally_t, set_random
   implicit none
   !> Numbers of right-hand sides, among them more than any block of them.
   integer, parameter :: sides(4) = [1, 3, 8, 17]
   type(tally_t) :: tally
   integer :: i, n

   call set_random()
   call of_nothing()
   call of_one()
   call a_matrix('diagonal', band(9, 0), whole=.true.)
   call a_matrix('dense', band(40, 40), whole=.true.)
   call a_matrix('wide dense', band(130, 130), whole=.true.)
   do i = 1, 7, 2
      call a_matrix('band', band(60, i))
   end do
   call a_matrix('arrow, its head last', arrow(50, 50))
   call a_matrix('arrow, its head first', arrow(50, 1), whole=.true.)
   call a_matrix('arrow, its head in the midst', arrow(50, 20))
   call a_matrix('disconnected', blocks(60, 7))
   call a_matrix('dense blocks', blocks(60, 30))
   do i = 1, 60
      call a_matrix('random', scattered(1 + modulo(7*i, 45), 0.02_wp*(1 + modulo(i, 9))))
   end do
   do i = 1, 4
      call a_matrix('larger', scattered(100, 0.01_wp*i))
   end do
   call zeros_that_are_stored()
   call a_grid(8, 1)
   call a_grid(24, 1)
   call a_grid(24, 2)
   call a_large_grid(60)
   call large_fronts()
   do i = 1, 40
      call not_definite(2 + i)
   end do
   call exact_zero_pivots()
   call the_least_column_fails()
   call what_is_not_finite()
   do n = 1, 12, 11
      call refactorised(10*n)
   end do
   call error_of_a_full_matrix(90)
   call memory_is_refused()
   call stopped()
   call tally%finish()

contains

   !> Symmetric and definite where there are entries; its sizes differ by powers of ten.
   function definite(is_there) result(dense)
      logical, intent(in) :: is_there(:, :)
      real(wp) :: dense(size(is_there, 1), size(is_there, 1)), grade(size(is_there, 1))
      integer :: i, j

      call random_number(dense)
      call random_number(grade)
      grade = 10.0_wp**(4*grade - 2)
      do j = 1, size(grade)
         do i = 1, size(grade)
            dense(i, j) = merge((dense(i, j) - 0.5_wp)*grade(i)*grade(j), 0.0_wp, is_there(max(i, j), min(i, j)))
         end do
      end do
      do j = 1, size(grade)
         dense(:j - 1, j) = dense(j, :j - 1)
         dense(j, j) = 0.0_wp
      end do
      do j = 1, size(grade)
         dense(j, j) = (1.0e-3_wp + sum(abs(dense(:, j))/grade)/grade(j))*grade(j)**2
      end do
   end function definite

   function band(n, width) result(is_there)
      integer, intent(in) :: n, width
      logical :: is_there(n, n)
      integer :: i, j
      do j = 1, n
         is_there(:, j) = [(abs(i - j) <= width, i=1, n)]
      end do
   end function band

   function arrow(n, head) result(is_there)
      integer, intent(in) :: n, head
      logical :: is_there(n, n)
      is_there = band(n, 0)
      is_there(head, :) = .true.
      is_there(:, head) = .true.
   end function arrow

   function blocks(n, length) result(is_there)
      integer, intent(in) :: n, length
      logical :: is_there(n, n)
      integer :: i, j
      do j = 1, n
         is_there(:, j) = [((i - 1)/length == (j - 1)/length, i=1, n)]
      end do
   end function blocks

   function scattered(n, chance) result(is_there)
      integer, intent(in) :: n
      real(wp), intent(in) :: chance
      logical :: is_there(n, n)
      real(wp) :: drawn(n, n)
      call random_number(drawn)
      is_there = drawn < chance .or. band(n, 0)
   end function scattered

   !> 0 to n - 1: as they come, backwards, or drawn.
   function some_order(n, kind) result(order)
      integer, intent(in) :: n, kind
      integer :: order(n), i, k, kept
      real(wp) :: drawn(n)

      order = [(merge(n - i, i - 1, kind == 2), i=1, n)]
      if (kind < 3) return
      call random_number(drawn)
      do i = n, 2, -1
         k = 1 + int(i*drawn(i))
         kept = order(k)
         order(k) = order(i)
         order(i) = kept
      end do
   end function some_order

   subroutine of_nothing()
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error
      real(wp) :: pivot(0), x(0, 3)
      integer :: failed

      call analyse_for(2, lower_t(0, [0], [integer ::]), [integer ::], factor, error)
      call tally%check(.not. allocated(error) .and. factor%n == 0 .and. factor%widest == 0, 'nothing: analysed')
      call tally%check(abs(factor%entries) <= 0, 'nothing: no entries')
      call factorise_by(2, factor, pivot, failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, 'nothing: factorised')
      call get_pivots(factor, pivot)
      call solve(factor, x, error)
      call tally%check(.not. allocated(error), 'solved')
      call tally%check(error_of_cholesky(factor, 0.0_wp) <= epsilon(1.0_wp), 'nothing: no error')
   end subroutine of_nothing

   subroutine of_one()
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error
      real(wp) :: pivot(1), x(1, 2)
      integer :: failed

      call analyse_for(2, lower_t(1, [0, 1], [0]), [0], factor, error)
      call tally%check(factor%n == 1 .and. factor%widest == 1 .and. nint(factor%entries) == 1, 'one: analysed')
      call factorise_by(1, factor, [4.0_wp], failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, 'one: factorised')
      call get_pivots(factor, pivot)
      call tally%near(pivot, [4.0_wp], 0.0_wp, 'one: pivot')
      x(1, :) = [8.0_wp, -2.0_wp]
      call solve(factor, x, error)
      call tally%check(.not. allocated(error), 'solved')
      call tally%near(x(1, :), [2.0_wp, -0.5_wp], 0.0_wp, 'one: solved')
      call factorise_by(1, factor, [0.0_wp], failed, error)
      call tally%check(.not. allocated(error) .and. failed == 1, 'one: zero is not definite')
      call factorise_by(2, factor, [-1.0_wp], failed, error)
      call tally%check(.not. allocated(error) .and. failed == 1, 'one: nor is less')
   end subroutine of_one

   !> In three orders, by one thread and by two. whole: no zeros can pad it in its own order.
   subroutine a_matrix(name, is_there, whole)
      character(len=*), intent(in) :: name
      logical, intent(in) :: is_there(:, :)
      logical, intent(in), optional :: whole
      logical :: both(size(is_there, 1), size(is_there, 1))
      real(wp) :: dense(size(is_there, 1), size(is_there, 1))
      integer :: kind

      both = is_there .or. transpose(is_there)
      dense = definite(both)
      do kind = 1, 3
         call in_order(name, dense, both, some_order(size(dense, 1), kind), 1, kind == 1 .and. present(whole))
      end do
      call in_order(name//' by two', dense, both, some_order(size(dense, 1), 3), 2, .false.)
   end subroutine a_matrix

   subroutine in_order(name, dense, is_there, order, threads, whole)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: is_there(:, :), whole
      integer, intent(in) :: order(:), threads
      type(lower_t) :: a
      type(cholesky_t) :: factor
      integer :: failed
      type(error_t), allocatable :: error

      a = lower_of(dense, is_there)
      call analyse_for(threads, a, order, factor, error)
      call tally%check(.not. allocated(error) .and. factor%n == a%n, name//': analysed')
      call check_counts(name, factor, fill_of(is_there(order + 1, order + 1)), whole)
      call factorise_by(threads, factor, a%value, failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, name//': factorised')
      call check_factor(name, factor, dense, is_there)
      call check_solutions(name, factor, dense)
   end subroutine in_order

   !> As many entries as elimination brings forth, and at most as many again that are zeros.
   subroutine check_counts(name, factor, fill, whole)
      character(len=*), intent(in) :: name
      type(cholesky_t), intent(in) :: factor
      logical, intent(in) :: fill(:, :), whole
      integer :: entries, widest

      entries = count(fill)
      widest = maxval(count(fill, 1))
      call tally%check(nint(factor%entries) >= entries .and. factor%widest >= widest, name//': all entries have room')
      call tally%check(factor%widest <= factor%n, name//': no column is longer than the matrix')
      if (whole) call tally%check(nint(factor%entries) == entries .and. factor%widest == widest, name//': no others')
      if (size(fill, 1) >= 100) call tally%check(factor%entries <= 2.0_wp*entries, name//': few others')
   end subroutine check_counts

   !> It is the factor, to its rounding; what pads it is zero; its pivots are its own.
   subroutine check_factor(name, factor, dense, is_there)
      character(len=*), intent(in) :: name
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: is_there(:, :)
      real(wp) :: l(factor%n, factor%n), a(factor%n, factor%n), pivot(factor%n)
      integer :: order(factor%n), i

      call entries_of(factor, l, order)
      call tally%check(all([(count(order == i) == 1, i=1, factor%n)]), name//': each column once')
      a = permuted(dense, order)
      call tally%check(largest_residual(l, a) <= 1.0_wp, name//': residual of rounding')
      call tally%check(all(fill_of(is_there(order, order)) .or. .not. abs(l) > 0), name//': zeros are zero')
      call get_pivots(factor, pivot)
      call tally%check(all([(abs(pivot(order(i)) - l(i, i)**2) <= epsilon(l)*l(i, i)**2, i=1, factor%n)]), name//': pivots')
      call check_error(name, factor, l, a)
   end subroutine check_factor

   !> The error is below its bound, which is not far above what sums of magnitudes tell.
   subroutine check_error(name, factor, l, a)
      character(len=*), intent(in) :: name
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: l(:, :), a(:, :)
      real(qp) :: made(factor%n, factor%n)
      real(wp) :: bound

      made = l
      made = matmul(made, transpose(made))
      bound = error_of_cholesky(factor, 0.0_wp)
      call tally%check(sqrt(real(sum((made - a)**2), wp)) <= bound, name//': error within its bound')
      call tally%check(bound > 0 .and. bound <= 0.5_wp*epsilon(bound)*(1 + 1.0e-6_wp)*(2*factor%widest + factor%n + 4)*sum(l**2), &
                       name//': bound no larger than need be')
   end subroutine check_error

   !> Residuals relative to |A| |x|, column by column.
   subroutine check_solutions(name, factor, dense)
      character(len=*), intent(in) :: name
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: dense(:, :)
      type(error_t), allocatable :: error
      real(wp) :: b(factor%n, maxval(sides)), x(factor%n, maxval(sides)), off
      integer :: k

      call random_number(b)
      do k = 1, size(sides)
         x = b
         call solve(factor, x(:, :sides(k)), error)
         call tally%check(.not. allocated(error), name//': solved without an error')
         off = maxval(norm2(matmul(dense, x(:, :sides(k))) - b(:, :sides(k)), 1)/ &
                      (norm2(dense)*norm2(x(:, :sides(k)), 1) + norm2(b(:, :sides(k)), 1)))
         call tally%check(off <= factor%n*epsilon(off), name//': solved')
         call tally%check(all(abs(x(:, sides(k) + 1:) - b(:, sides(k) + 1:)) <= 0), name//': no others touched')
      end do
   end subroutine check_solutions

   !> Zeros that are stored count as entries.
   subroutine zeros_that_are_stored()
      integer, parameter :: n = 30
      logical :: is_there(n, n)
      real(wp) :: dense(n, n)

      is_there = scattered(n, 0.1_wp)
      is_there = is_there .or. transpose(is_there)
      dense = definite(band(n, 0))
      call in_order('stored zeros', dense, is_there, some_order(n, 3), 1, .false.)
   end subroutine zeros_that_are_stored

   !> Five-point stars on a square, in nested dissection.
   function star(n) result(is_there)
      integer, intent(in) :: n
      logical :: is_there(n*n, n*n)
      integer :: i
      is_there = band(n*n, 0)
      do i = 1, n*n
         if (modulo(i, n) /= 0) is_there(i + 1, i) = .true.
         if (i + n <= n*n) is_there(i + n, i) = .true.
      end do
      is_there = is_there .or. transpose(is_there)
   end function star

   subroutine a_grid(n, threads)
      integer, intent(in) :: n, threads
      logical :: is_there(n*n, n*n)
      real(wp) :: dense(n*n, n*n), l(n*n, n*n)
      type(lower_t) :: a
      type(cholesky_t) :: factor
      integer :: failed, order(n*n)
      type(error_t), allocatable :: error

      is_there = star(n)
      if (n < 10) then
         call in_order('small grid', definite(is_there), is_there, nested_grid(n), threads, .false.)
         return
      end if
      dense = definite(is_there)
      a = lower_of(dense, is_there)
      order = nested_grid(n)
      call analyse_for(threads, a, order, factor, error)
      call check_counts('grid', factor, fill_of(is_there(order + 1, order + 1)), .false.)
      call factorise_by(threads, factor, a%value, failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, 'grid: factorised')
      call entries_of(factor, l, order)
      associate (m => abs(matmul(l, transpose(l)) - permuted(dense, order)), s => matmul(abs(l), transpose(abs(l))))
         call tally%check(all(m <= 2*n*epsilon(1.0_wp)*s), 'grid: residual of rounding')
      end associate
      call check_solutions('grid', factor, dense)
   end subroutine a_grid

   !> Differences of neighbours, a fixed edge around: of ones only the edge is left. Large enough
   !> for threads to share it; both give the same.
   subroutine a_large_grid(n)
      integer, intent(in) :: n
      type(lower_t) :: a
      type(cholesky_t) :: factor(2)
      type(error_t), allocatable :: error
      real(wp) :: x(n*n, 2), pivot(n*n, 2)
      integer :: failed, t

      a = laplacian(n)
      do t = 1, 2
         call analyse_for(t, a, nested_grid(n), factor(t), error)
         call factorise_by(t, factor(t), a%value, failed, error)
         call tally%check(.not. allocated(error) .and. failed == 0, 'large grid: factorised')
         call get_pivots(factor(t), pivot(:, t))
         x(:, t:t) = reshape(edge(n), [n*n, 1])
         call solve(factor(t), x(:, t:t), error)
         call tally%check(all(abs(x(:, t) - 1) <= 1.0e-11_wp), 'large grid: solved')
      end do
      call tally%check(abs(factor(1)%entries - factor(2)%entries) <= 0, 'large grid: the same entries')
      call tally%check(all(abs(pivot(:, 2) - pivot(:, 1)) <= 1.0e-13_wp), 'large grid: the same pivots')
   end subroutine a_large_grid

   !> Two parts that hang on a third and on the last, as the third and a fourth do: the third and the
   !> last are worked on by all threads, in pieces. Right-hand sides are more than are filled up, and
   !> one.
   subroutine large_fronts()
      integer, parameter :: part(5) = [150, 150, 600, 150, 1400], n = sum(part)
      type(lower_t) :: a
      type(cholesky_t) :: factor(3)
      type(error_t), allocatable :: error
      real(wp) :: x(n, 11), b(n, 11), pivot(n, 3)
      integer :: failed, t, k

      a = parts(part)
      call random_number(x)
      b = product_with(a, x)
      do t = 1, 3
         call analyse_for(t, a, [(k, k=0, n - 1)], factor(t), error)
         call tally%check(t == 1 .or. count(factor(t)%tasks%of_supernode == 0) > 1, 'large fronts: some above the tasks')
         call factorise_by(t, factor(t), a%value, failed, error)
         call tally%check(.not. allocated(error) .and. failed == 0, 'large fronts: factorised')
         call get_pivots(factor(t), pivot(:, t))
         call tally%check(all(abs(pivot(:, t) - pivot(:, 1)) <= 1.0e-12_wp*pivot(:, 1)), 'large fronts: the same pivots')
         associate (many => solved(factor(t), b), one => solved(factor(t), b(:, :1)))
            call tally%check(all(abs(many - x) <= 1.0e-12_wp), 'large fronts: solved')
            call tally%check(all(abs(one - x(:, :1)) <= 1.0e-12_wp), 'large fronts: solved, one')
         end associate
      end do
   end subroutine large_fronts

   function solved(factor, b) result(x)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: b(:, :)
      real(wp), allocatable :: x(:, :)
      type(error_t), allocatable :: error

      allocate (x, source=b)
      call solve(factor, x, error)
      call tally%check(.not. allocated(error), 'solved without an error')
   end function solved

   !> Random entries, and a diagonal that dominates, where two columns are of one part, or else the
   !> later one is among the last of its part, or for the first part among the first of the third.
   function parts(part) result(a)
      integer, intent(in) :: part(5)
      type(lower_t) :: a
      logical :: is_there(5, sum(part))
      integer :: i, j, k, entry, of(sum(part))

      of = [(spread(k, 1, part(k)), k=1, 5)]
      is_there = .false.
      is_there(:4, sum(part) - 399:) = .true.
      is_there(:3, sum(part) - 999:) = .true.
      is_there(1, 301:500) = .true.
      is_there(2, 701:900) = .true.
      a%n = sum(part)
      allocate (a%start(a%n + 1), source=0)
      allocate (a%place(a%n*(a%n + 1)/2), source=0)
      allocate (a%value(a%n*(a%n + 1)/2), source=0.0_wp)
      call random_number(a%value)
      entry = 0
      do j = 1, a%n
         do i = j, a%n
            if (.not. (of(i) == of(j) .or. is_there(of(j), i))) cycle
            entry = entry + 1
            a%place(entry) = i - 1
            if (i == j) a%value(entry) = a%value(entry) + a%n
         end do
         a%start(j + 1) = entry
      end do
      a%place = a%place(:entry)
      a%value = a%value(:entry)
   end function parts

   pure function product_with(a, x) result(b)
      type(lower_t), intent(in) :: a
      real(wp), intent(in) :: x(:, :)
      real(wp) :: b(size(x, 1), size(x, 2))
      integer :: j, e, i

      b = 0.0_wp
      do j = 1, a%n
         do e = a%start(j) + 1, a%start(j + 1)
            i = a%place(e) + 1
            b(i, :) = b(i, :) + a%value(e)*x(j, :)
            if (i /= j) b(j, :) = b(j, :) + a%value(e)*x(i, :)
         end do
      end do
   end function product_with

   pure function laplacian(n) result(a)
      integer, intent(in) :: n
      type(lower_t) :: a
      integer :: i, entry

      a%n = n*n
      allocate (a%start(n*n + 1), source=0)
      allocate (a%place(3*n*n), source=0)
      allocate (a%value(3*n*n), source=-1.0_wp)
      entry = 0
      do i = 1, n*n
         entry = entry + 1
         a%place(entry) = i - 1
         a%value(entry) = 4.0_wp
         if (modulo(i, n) /= 0) then
            entry = entry + 1
            a%place(entry) = i
         end if
         if (i + n <= n*n) then
            entry = entry + 1
            a%place(entry) = i + n - 1
         end if
         a%start(i + 1) = entry
      end do
      a%place = a%place(:entry)
      a%value = a%value(:entry)
   end function laplacian

   !> How many neighbours are missing.
   pure function edge(n) result(missing)
      integer, intent(in) :: n
      real(wp) :: missing(n*n)
      integer :: i, j
      missing = [((count([i == 1, i == n, j == 1, j == n]), i=1, n), j=1, n)]
   end function edge

   !> Somewhere a diagonal entry is far too small: it fails where dense elimination does.
   subroutine not_definite(n)
      integer, intent(in) :: n
      logical :: is_there(n, n)
      real(wp) :: dense(n, n), drawn(2)
      integer :: k

      is_there = scattered(n, 3.0_wp/n)
      is_there = is_there .or. transpose(is_there)
      dense = definite(is_there)
      call random_number(drawn)
      do k = 1, 2
         associate (j => 1 + int(n*drawn(k)))
            dense(j, j) = merge(1.0e-12_wp, -0.5_wp, k == 1)*dense(j, j)
         end associate
      end do
      do k = 1, 3
         call fails_as_dense('not definite', dense, is_there, some_order(n, k), modulo(k, 2) + 1)
      end do
   end subroutine not_definite

   subroutine fails_as_dense(name, dense, is_there, order, threads)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: is_there(:, :)
      integer, intent(in) :: order(:), threads
      type(lower_t) :: a
      type(cholesky_t) :: factor
      type(failing_t) :: found
      integer :: failed
      type(error_t), allocatable :: error

      a = lower_of(dense, is_there)
      call analyse_for(threads, a, order, factor, error)
      call factorise_by(threads, factor, a%value, failed, error)
      found = failing(permuted(dense, order + 1), fill_of(is_there(order + 1, order + 1)), 0.0_wp)
      call tally%check(.not. allocated(error), name//': no other error')
      if (failed < 1 .or. failed > size(order)) then
         call tally%check(failed == 0 .and. .not. any(found%fails), name//': whether it fails')
      else
         call tally%check(found%fails(findloc(order, failed - 1, 1)), name//': where it fails')
      end if
   end subroutine fails_as_dense

   !> L has whole numbers and powers of two on its diagonal: nothing rounds, pivots come out
   !> as they are, and one that is zero is zero.
   subroutine exact_zero_pivots()
      integer, parameter :: n = 25
      logical :: is_there(n, n)
      real(wp) :: l(n, n), drawn(n, n), made(n, n)
      integer :: i, k, order(n)

      do k = 1, 60
         call random_number(drawn)
         is_there = fill_of(scattered(n, 0.12_wp))
         l = merge(real(int(7*drawn) - 3, wp), 0.0_wp, is_there)
         do i = 1, n
            l(i, i) = 2.0_wp**int(3*drawn(i, i))
         end do
         made = matmul(l, transpose(l))
         order = some_order(n, 1)
         call check_exact(made, is_there, order, l)
         i = 1 + int(n*drawn(1, 2))
         made(i, i) = made(i, i) - l(i, i)**2
         call fails_as_dense('zero pivot', made, is_there .or. transpose(is_there), order, 1)
         made(i, i) = made(i, i) + 1.0e-6_wp
         call fails_as_dense('pivot above zero', made, is_there .or. transpose(is_there), order, 2)
      end do
   end subroutine exact_zero_pivots

   subroutine check_exact(dense, is_there, order, l)
      real(wp), intent(in) :: dense(:, :), l(:, :)
      logical, intent(in) :: is_there(:, :)
      integer, intent(in) :: order(:)
      type(lower_t) :: a
      type(cholesky_t) :: factor
      real(wp) :: pivot(size(order)), found(size(order), size(order))
      integer :: failed, i, places(size(order))
      type(error_t), allocatable :: error

      a = lower_of(dense, is_there)
      call analyse_for(1, a, order, factor, error)
      call factorise_by(1, factor, a%value, failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, 'whole numbers: factorised')
      call get_pivots(factor, pivot)
      call tally%near(pivot, [(l(i, i)**2, i=1, size(order))], 0.0_wp, 'whole numbers: pivots')
      call entries_of(factor, found, places)
      call tally%check(all(abs(found - sorted_back(l, places)) <= 0), 'whole numbers: the factor itself')
   end subroutine check_exact

   !> The factor in an equivalent order.
   pure function sorted_back(l, places) result(made)
      real(wp), intent(in) :: l(:, :)
      integer, intent(in) :: places(:)
      real(wp) :: made(size(places), size(places))
      made = l(places, places)
   end function sorted_back

   !> All pivots of a diagonal matrix, and of two dense blocks, fail: whoever looks, the same
   !> column is told by one thread and by two.
   subroutine the_least_column_fails()
      integer, parameter :: n = 120
      type(lower_t) :: a
      type(cholesky_t) :: factor
      integer, parameter :: length(3) = [1, 5, 60]
      integer :: failed(6), i, k
      type(error_t), allocatable :: error

      do k = 1, 3
         a = lower_of(-definite(blocks(n, length(k))), blocks(n, length(k)))
         call analyse_for(2, a, some_order(n, 1), factor, error)
         do i = 1, size(failed)
            call factorise_by(1 + modulo(i, 2), factor, a%value, failed(i), error)
         end do
         call tally%check(all(failed == failed(1)) .and. failed(1) > 0, 'the least column fails')
      end do
   end subroutine the_least_column_fails

   !> Numbers that are not finite, on the diagonal and below it, end in failure.
   subroutine what_is_not_finite()
      integer, parameter :: n = 40, long = 150
      integer :: k, i

      do k = 1, 3
         do i = 1, n, 3
            call not_finite(scattered(n, 0.08_wp), n, i, k)
         end do
         call not_finite(band(n, n), n, 17, k)
         call not_finite(band(long, long), long, 100, k)
         call not_finite(band(1, 1), 1, 1, k)
      end do
   end subroutine what_is_not_finite

   subroutine not_finite(is_there, n, i, kind)
      logical, intent(in) :: is_there(:, :)
      integer, intent(in) :: n, i, kind
      type(lower_t) :: a
      type(cholesky_t) :: factor
      real(wp) :: bad
      real(wp), allocatable :: value(:)
      integer :: failed, entry, threads
      type(error_t), allocatable :: error

      a = lower_of(definite(is_there .or. transpose(is_there)), is_there .or. transpose(is_there))
      bad = ieee_value(bad, ieee_quiet_nan)
      if (kind == 2) bad = ieee_value(bad, ieee_positive_inf)
      if (kind == 3) bad = ieee_value(bad, ieee_negative_inf)
      call analyse_for(2, a, some_order(n, 3), factor, error)
      ! On the diagonal, then at the end of the column.
      do entry = a%start(i) + 1, a%start(i + 1), max(1, a%start(i + 1) - a%start(i) - 1)
         do threads = 1, 2
            value = a%value
            value(entry) = bad
            call factorise_by(threads, factor, value, failed, error)
            call tally%check(.not. allocated(error) .and. failed > 0 .and. failed <= n, 'not finite: fails')
         end do
      end do
   end subroutine not_finite

   !> One analysis serves for many matrices, also after one that is not definite.
   subroutine refactorised(n)
      integer, intent(in) :: n
      logical :: is_there(n, n)
      real(wp) :: dense(n, n)
      type(lower_t) :: a
      type(cholesky_t) :: factor
      integer :: failed, k
      type(error_t), allocatable :: error

      is_there = scattered(n, 3.0_wp/n)
      is_there = is_there .or. transpose(is_there)
      dense = definite(is_there)
      a = lower_of(dense, is_there)
      call analyse_for(2, a, some_order(n, 3), factor, error)
      do k = 1, 4
         dense = merge(-1.0_wp, 1.0_wp, k == 2)*definite(is_there)
         a = lower_of(dense, is_there)
         call factorise_by(1 + k/3, factor, a%value, failed, error)
         call tally%check(.not. allocated(error) .and. (failed > 0 .eqv. k == 2), 'again: whether it is definite')
         if (k == 2) cycle
         call check_factor('again', factor, dense, is_there)
         call check_solutions('again', factor, dense)
      end do
   end subroutine refactorised

   !> Of a full matrix, where it can be written down.
   subroutine error_of_a_full_matrix(n)
      integer, intent(in) :: n
      real(wp) :: dense(n, n), l(n, n)
      type(lower_t) :: a
      type(cholesky_t) :: factor
      integer :: failed, order(n)
      type(error_t), allocatable :: error

      dense = definite(band(n, n))
      a = lower_of(dense, band(n, n))
      call analyse_for(1, a, some_order(n, 1), factor, error)
      call factorise_by(1, factor, a%value, failed, error)
      call entries_of(factor, l, order)
      call tally%near([error_of_cholesky(factor, 0.0_wp)/bound_of_full(l)], [1.0_wp], 1.0e-10_wp, 'bound of a full factor')
   end subroutine error_of_a_full_matrix

   !> A full factor of 600,000 columns has 1.4 TB: it is refused, and what it needs is told.
   !> Where the system lends whatever is asked for this cannot be tried.
   subroutine memory_is_refused()
      integer, parameter :: n = 600000
      type(cholesky_t) :: factor
      type(lower_t) :: a
      type(error_t), allocatable :: error
      integer :: failed, i

      if (lends_all()) return
      a = lower_t(n, [0, n, (n + i, i=1, n - 1)], [(i, i=0, n - 1), (i, i=1, n - 1)], spread(1.0_wp, 1, 2*n - 1))
      call analyse_for(2, a, [(i, i=0, n - 1)], factor, error)
      call tally%check(is_kind(error, error_memory) .or. abs(factor%entries/(0.5_wp*n*(n + 1.0_wp)) - 1) < 1.0e-12_wp, &
                       'memory: what is needed')
      if (allocated(error)) return
      call tally%check(factor%widest == n, 'memory: widest')
      call factorise_by(2, factor, a%value, failed, error)
      call tally%check(is_kind(error, error_memory), 'memory: refused')
   end subroutine memory_is_refused

   !> What nobody waits for any more ends between two supernodes, and can be begun again.
   subroutine stopped()
      integer, parameter :: n = 20
      type(lower_t) :: a
      type(cholesky_t) :: factor
      type(progress_t) :: progress
      integer, target :: stage(3)
      type(error_t), allocatable :: error
      real(wp) :: x(n*n, 1)
      integer :: failed

      a = laplacian(n)
      call analyse_for(2, a, nested_grid(n), factor, error)
      progress%stage => stage
      stage = [0, 0, 1]
      call factorise(factor, a%value, progress, failed, error)
      call tally%check(is_kind(error, error_interrupted) .and. failed == 0, 'stopped')
      stage(3) = 0
      call factorise(factor, a%value, progress, failed, error)
      call tally%check(.not. allocated(error) .and. failed == 0, 'and begun again')
      call tally%check(stage(2) >= 0 .and. stage(2) <= 100, 'per cent are told')
      x(:, 1) = edge(n)
      call solve(factor, x, error)
      call tally%check(all(abs(x - 1) <= 1.0e-11_wp), 'with its result')
   end subroutine stopped

   logical function lends_all()
      integer :: unit, status, answer
      answer = 1
      open (newunit=unit, file='/proc/sys/vm/overcommit_memory', action='read', status='old', iostat=status)
      if (status == 0) read (unit, *, iostat=status) answer
      if (status == 0) close (unit)
      lends_all = status /= 0 .or. answer == 1
   end function lends_all
end program test_cholesky
