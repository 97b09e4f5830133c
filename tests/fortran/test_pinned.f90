! SPDX-License-Identifier: BSD-3-Clause
!> The pinned factorisation and what is found with it: how many singular values
!> are below t, the smallest ones, and both null spaces, of matrices whose values
!> are known. Some are narrow, so that their columns are taken along the band.
program test_pinned
   use flexact_error, only: error_t, is_kind, error_memory, error_not_definite
   use flexact_first_block, only: first_block_t, make_first_block
   use flexact_kinds, only: wp
   use flexact_lanczos, only: next_space
   use flexact_left_null_space, only: left_null_space
   use flexact_pin_search, only: seek_pins, repin, low_end
   use flexact_pinned, only: pinned_t, make_pinned, shift, shift_and_mark, pin, apply_inverse, release
   use flexact_pinned_space, only: pinned_space
   use flexact_progress, only: progress_t
   use flexact_sparse, only: sparse_t, operator_t, operator_of, times, times_transposed
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   use flexact_test_matrices, only: identity, sparse_of, random_orthogonal, banded, grid, path
   use flexact_testing, only: tally_t, set_random
   implicit none
   real(wp), parameter :: pi = acos(-1.0_wp)
   type(tally_t) :: tally
   integer :: i

   call set_random()
   call a_fixed_path()
   call a_ring()
   call thousands_of_equal_values()
   call values_just_above()
   call nothing_but_the_null_space()
   call dependent_columns()
   call a_long_path()
   call nothing_at_all()
   call planted_values('narrow', 20, 12, [1.0e-9_wp, 0.0_wp, 0.0_wp])
   call planted_values('narrow', 12, 12, [0.0_wp])
   call planted_values('narrow', 12, 12, [real(wp) ::])
   call planted_values('one column', 5, 1, [real(wp) ::])
   call planted_values('all but one', 6, 4, [3.0e-9_wp, 1.0e-10_wp, 0.0_wp])
   call too_few_pins('narrow', 40)
   call too_few_pins_in_a_path()
   call a_fixed_grid()
   call a_torus()
   call planted_values('wide', 160, 120, [1.0e-9_wp, 0.0_wp, 0.0_wp])
   call planted_values('wide', 120, 120, [(0.0_wp, i=1, 40)])
   call planted_values('wide', 130, 120, [real(wp) ::])
   call too_few_pins('wide', 100)
   call shifting_a_ring()
   call shifting_brings_forth_the_null_space()
   call memory_that_does_not_suffice()
   call tally%finish()

contains

   !> Each column is a group of its own.
   subroutine factorise(a, pinned, error, memory)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(out) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: memory
      real(wp) :: most
      integer :: j

      most = huge(most)
      if (present(memory)) most = memory
      call make_pinned(a, [(j, j=1, a%by_column%columns)], most, progress_t(), pinned, error)
   end subroutine factorise

   function product_with(matrix, x) result(y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in) :: x(:, :)
      real(wp) :: y(matrix%rows, size(x, 2))
      call times(matrix, x, y)
   end function product_with

   subroutine check_orthonormal(vectors, tolerance, name)
      real(wp), intent(in) :: vectors(:, :), tolerance
      character(len=*), intent(in) :: name
      call tally%near([matmul(transpose(vectors), vectors)], [identity(size(vectors, 2))], tolerance, name)
   end subroutine check_orthonormal

   !> Whether vectors are orthonormal singular vectors of their values.
   subroutine check_singular(a, vectors, values, name)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: vectors(:, :), values(:)
      character(len=*), intent(in) :: name

      call check_orthonormal(vectors, 1.0e-13_wp, name//': orthonormal')
      associate (image => product_with(a%by_column, vectors))
         call tally%near(sqrt(sum(image**2, 1)), values, 1.0e-13_wp, name//': lengths of images')
      end associate
   end subroutine check_singular

   !> Left null vectors: so many, orthonormal, that A' sends to zero.
   subroutine check_left(a, pinned, wanted, name, vectors)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(out) :: vectors(:, :)
      real(wp) :: none(a%by_column%rows, 0)
      type(error_t), allocatable :: error

      call left_null_space(a, pinned, none, wanted, vectors, error)
      call tally%check(.not. allocated(error), name//': left null space')
      call tally%check(size(vectors, 1) == a%by_column%rows .and. size(vectors, 2) == wanted, name//': its size')
      call check_orthonormal(vectors, 1.0e-13_wp, name//': left, orthonormal')
      call tally%check(all(abs(product_with(a%by_row, vectors)) <= 1.0e-13_wp), name//': what A'' leaves')
   end subroutine check_left

   !> The smallest values beyond the pins are these. beside: the block that was taken along when
   !> the lowest were found.
   subroutine check_next(a, pinned, lowest, expected, tolerance, name, beside)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in) :: lowest(:, :), expected(:), tolerance
      character(len=*), intent(in) :: name
      type(first_block_t), intent(in), optional :: beside
      type(sparse_basis_t) :: deflated
      type(first_block_t) :: start
      real(wp), allocatable :: vectors(:, :), values(:)
      type(error_t), allocatable :: error

      if (present(beside)) start = beside
      call new_sparse_basis(deflated)
      call next_space(a, pinned, deflated, lowest, size(expected), .true., start, vectors, values, error)
      call tally%check(.not. allocated(error), name//': next values')
      call tally%check(size(values) > 0 .and. size(values) <= size(expected), name//': some of them')
      call tally%near(values, expected(:size(values)), tolerance, name//': what they are')
      call check_singular(a, vectors, values, name//', next')
      call tally%check(all(abs(matmul(transpose(lowest), vectors)) <= 1.0e-13_wp), name//': apart from the lowest')
   end subroutine check_next

   !> No value is below t; ones are sent to zero by A' alone.
   subroutine a_fixed_path()
      integer, parameter :: n = 150
      type(operator_t) :: a
      type(pinned_t) :: pinned
      real(wp), allocatable :: left(:, :)
      real(wp) :: none(n, 0)
      type(error_t), allocatable :: error
      integer :: k

      a = operator_of(path(n, .false.))
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 0, 'path: no pins')
      call check_next(a, pinned, none, [(2*sin(k*pi/(2*(n + 1))), k=1, 6)], 1.0e-12_wp, 'path')
      call check_left(a, pinned, 1, 'path', left)
      call tally%near(left(:, 1)/left(1, 1), spread(1.0_wp, 1, n + 1), 1.0e-11_wp, 'path: the left null vector')
      call release(pinned)
   end subroutine a_fixed_path

   !> Ones are sent to zero by A and by A'; the other values come in pairs.
   subroutine a_ring()
      integer, parameter :: n = 90
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(sparse_basis_t) :: deflated
      real(wp), allocatable :: vectors(:, :), values(:), left(:, :)
      type(error_t), allocatable :: error

      a = operator_of(path(n, .true.))
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 1, 'ring: one pin')
      call new_sparse_basis(deflated)
      call pinned_space(a, pinned, pinned%pin, deflated, vectors, values, error)
      call tally%check(.not. allocated(error), 'ring: pinned space')
      call tally%near(values, [0.0_wp], 1.0e-14_wp, 'ring: its value')
      call tally%near(vectors(:, 1)/vectors(1, 1), spread(1.0_wp, 1, n), 1.0e-13_wp, 'ring: its vector')
      call check_next(a, pinned, vectors, 2*sin([1, 1, 2, 2, 3, 3]*pi/n), 1.0e-12_wp, 'ring')
      call check_left(a, pinned, 1, 'ring', left)
      call tally%near(left(:, 1)/left(1, 1), spread(1.0_wp, 1, n), 1.0e-11_wp, 'ring: the left null vector')
      call release(pinned)
   end subroutine a_ring

   !> All values are 1 but for one in a hundred, which is zero, and two of 1e-9:
   !> the null space is that of the known vectors.
   subroutine thousands_of_equal_values()
      integer, parameter :: n = 2000
      real(wp), allocatable :: values(:), lefts(:, :), rights(:, :), vectors(:, :), found(:), left(:, :)
      real(wp) :: expected(n/100 + 2)
      integer, allocatable :: low(:)
      type(sparse_t) :: matrix
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(sparse_basis_t) :: deflated
      type(error_t), allocatable :: error
      integer :: k

      allocate (values(n), source=1.0_wp)
      values(50::100) = 0.0_wp
      values([333, 1666]) = 1.0e-9_wp
      call banded(values, matrix, lefts, rights)
      a = operator_of(matrix)
      low = pack([(k, k=1, n)], values < 0.5_wp)
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error), 'equal values: pinned')
      call tally%check(pinned%pins == size(low), 'equal values: as many pins as are low')
      call new_sparse_basis(deflated)
      call pinned_space(a, pinned, pinned%pin, deflated, vectors, found, error)
      expected = 0.0_wp
      expected(n/100 + 1:) = 1.0e-9_wp
      call tally%near(found, expected, 1.0e-15_wp, 'equal values: the low ones')
      call check_singular(a, vectors, found, 'equal values')
      vectors = vectors - matmul(rights(:, low), matmul(transpose(rights(:, low)), vectors))
      call tally%check(all(abs(vectors) <= 1.0e-13_wp), 'equal values: the space of the known vectors')
      call check_next(a, pinned, rights(:, low), spread(1.0_wp, 1, 6), 1.0e-13_wp, 'equal values')
      associate (zero => pack(low, values(low) <= 0), held => pack(low, values(low) > 0))
         call left_null_space(a, pinned, lefts(:, held), size(zero), left, error)
         call tally%check(.not. allocated(error), 'equal values: left')
         call check_orthonormal(left, 1.0e-13_wp, 'equal values: left, orthonormal')
         left = left - matmul(lefts(:, zero), matmul(transpose(lefts(:, zero)), left))
         call tally%check(all(abs(left) <= 1.0e-12_wp), 'equal values: the left null space')
      end associate
      call release(pinned)
   end subroutine thousands_of_equal_values

   !> Values of four times t and more are not low, but a projection leaves a tenth of what is along
   !> them: the left null space is that of the known vectors even so.
   subroutine values_just_above()
      integer, parameter :: n = 300
      real(wp), allocatable :: values(:), lefts(:, :), rights(:, :), left(:, :)
      integer, allocatable :: zero(:)
      type(sparse_t) :: matrix
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error
      integer :: k

      allocate (values(n), source=1.0_wp)
      values(20::40) = [(1.1e-6_wp*1.2_wp**k, k=1, 7)]
      values([90, 210]) = 0.0_wp
      zero = pack([(k, k=1, n)], values <= 0)
      call banded(values, matrix, lefts, rights)
      a = operator_of(matrix)
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins >= size(zero), 'just above: pinned')
      call tally%check(minval(values, values > 0) > 3*pinned%least, 'just above: not low')
      call check_left(a, pinned, size(zero), 'just above', left)
      left = left - matmul(lefts(:, zero), matmul(transpose(lefts(:, zero)), left))
      call tally%check(all(abs(left) <= 1.0e-11_wp), 'just above: the left null space')
      call release(pinned)
   end subroutine values_just_above

   !> Where all other directions are known, nothing is left to be projected but rounding.
   subroutine nothing_but_the_null_space()
      real(wp), parameter :: matrix(3, 2) = reshape([1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp], [3, 2])
      real(wp), parameter :: known(3, 2) = reshape([[1.0_wp, 1.0_wp, 0.0_wp]/sqrt(2.0_wp), &
                                                    [-1.0_wp, 1.0_wp, 2.0_wp]/sqrt(6.0_wp)], [3, 2])
      real(wp), allocatable :: left(:, :)
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error

      a = operator_of(sparse_of(matrix))
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error), 'nothing else: pinned')
      call find_left(a, pinned, known, 1, left, 'nothing else')
      call tally%near(left(:, 1)/left(1, 1), [1.0_wp, -1.0_wp, 1.0_wp], 1.0e-13_wp, 'nothing else: the third direction')
      call release(pinned)
   end subroutine nothing_but_the_null_space

   !> Columns 4 and 7 are sums of others: so many are pinned, and the inverse is that of A'A with
   !> ones there, less t**2.
   subroutine dependent_columns()
      integer, parameter :: n = 9
      real(wp) :: dense(20, n), expected(n, n), x(n, 1), b(n, 1)
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error
      integer :: k

      call random_number(dense)
      dense = dense - 0.5_wp
      dense(:, 4) = dense(:, 1) - 2*dense(:, 3)
      dense(:, 7) = dense(:, 5) + dense(:, 4)
      call factorise(operator_of(sparse_of(dense)), pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 2, 'dependent: two pins')
      expected = matmul(transpose(dense), dense) - pinned%least**2*identity(n)
      do k = 1, pinned%pins
         expected(pinned%pin(k), pinned%pin(k)) = expected(pinned%pin(k), pinned%pin(k)) + 1
      end do
      call random_number(b)
      x = b
      call apply_inverse(pinned, x, error)
      call tally%near([matmul(expected, x)], [b], 1.0e-10_wp, 'dependent: solutions')
      call release(pinned)
   end subroutine dependent_columns

   !> Of the path A'A = [2 -1; -1 2 -1; ..] and the inverse sends ones to i (n + 1 - i)/2, but
   !> for t**2, which stands below its lowest eigenvalue, pi**2/n**2.
   subroutine a_long_path()
      integer, parameter :: n = 1000
      type(pinned_t) :: pinned
      real(wp) :: x(n, 1)
      type(error_t), allocatable :: error
      integer :: k

      call factorise(operator_of(path(n, .false.)), pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 0, 'long path: stiff')
      x = 1.0_wp
      call apply_inverse(pinned, x, error)
      call tally%near(x(:, 1)/[(0.5_wp*k*(n + 1 - k), k=1, n)], spread(1.0_wp, 1, n), &
                      1.0e-9_wp + 2*pinned%least**2*n**2/pi**2, 'long path: a parabola')
      call release(pinned)
   end subroutine a_long_path

   !> A column of zeros is pinned, which gives one.
   subroutine nothing_at_all()
      real(wp) :: zero(2, 1), x(1, 1)
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error

      zero = 0.0_wp
      call factorise(operator_of(sparse_of(zero)), pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 1, 'nothing: pinned')
      x = 3.0_wp
      call apply_inverse(pinned, x, error)
      call tally%near([x], [3.0_wp], 6*pinned%least**2, 'nothing: which gives one')
      call release(pinned)
   end subroutine nothing_at_all

   !> U diag(.05 .. 1, low) V' with random U (m, m) and V (n, n), which is dense: the
   !> count is proven, and the low values with both null spaces are found.
   subroutine planted_values(name, m, n, low)
      character(len=*), intent(in) :: name
      integer, intent(in) :: m, n
      real(wp), intent(in) :: low(:)
      real(wp) :: u(m, m), v(n, n), s(n), found(size(low))
      real(wp), allocatable :: vectors(:, :), left(:, :)
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(first_block_t) :: beside
      integer :: zeros, high, k

      high = n - size(low)
      zeros = count(low <= 0)
      u = random_orthogonal(m)
      v = random_orthogonal(n)
      s(:high) = [((1 - 0.5_wp*(k - 1)/n)*min(1.0_wp, 0.1_wp*(high - k + 1)), k=1, high)]
      s(high + 1:) = low
      a = operator_of(sparse_of(matmul(u(:, :n)*spread(s, 1, m), transpose(v))))
      call prove(a, size(low), pinned, name)
      call find_low(a, pinned, vectors, found, beside)
      call tally%near(found, low(size(low):1:-1), 1.0e-14_wp, name//': low values')
      call check_beside(pinned, beside, vectors, name)
      call check_singular(a, vectors, found, name)
      call tally%check(all(abs(matmul(transpose(v(:, :high)), vectors)) <= 1.0e-12_wp), name//': their space')
      if (high > 0) then
         call check_next(a, pinned, vectors, s(high:max(1, high - 2):-1), 1.0e-12_wp, name)
         call check_next(a, pinned, vectors, s(high:max(1, high - 2):-1), 1.0e-12_wp, name//', beside', beside)
         call check_misled(a, pinned, beside, vectors, s(high), name)
      end if
      associate (held => high + [(k, k=1, size(low) - zeros)])
         call find_left(a, pinned, u(:, held), m - n + zeros, left, name)
      end associate
      call tally%check(all(abs(matmul(transpose(u(:, :n - zeros)), left)) <= 1.0e-6_wp), name//': the left null space')
      call release(pinned)
   end subroutine planted_values

   !> Pin until so many pins make the matrix definite.
   subroutine prove(a, pins, pinned, name)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: pins
      type(pinned_t), intent(out) :: pinned
      character(len=*), intent(in) :: name
      type(sparse_basis_t) :: deflated
      real(wp), allocatable :: vectors(:, :), values(:)
      type(error_t), allocatable :: error

      call factorise(a, pinned, error)
      if (is_kind(error, error_not_definite)) call seek_pins(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins >= pins, name//': enough pins')
      if (pinned%pins > pins) then
         call new_sparse_basis(deflated)
         call pinned_space(a, pinned, pinned%pin, deflated, vectors, values, error)
         associate (low => count(values <= low_end*pinned%least))
            call repin(vectors(:, :low), [integer ::], pinned, error)
         end associate
      end if
      call tally%check(.not. allocated(error), name//': definite')
      call tally%check(pinned%pins == pins .and. size(pinned%pin) == pins, name//': no more than that are low')
   end subroutine prove

   subroutine find_low(a, pinned, vectors, values, beside)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), allocatable, intent(out) :: vectors(:, :)
      real(wp), intent(out) :: values(:)
      type(first_block_t), intent(out) :: beside
      type(sparse_basis_t) :: deflated
      real(wp), allocatable :: found(:)
      type(error_t), allocatable :: error

      call new_sparse_basis(deflated)
      call make_first_block(pinned%n, pinned%n - pinned%pins, min(3, pinned%n - pinned%pins), .true., beside%vectors)
      call pinned_space(a, pinned, pinned%pin, deflated, vectors, found, error, beside)
      call tally%check(.not. allocated(error) .and. size(found) == size(values), 'vectors of the pins')
      values = found
   end subroutine find_low

   !> Where a step was taken with the block beside, it is orthonormal, and of it inverse(F) is known.
   subroutine check_beside(pinned, beside, lowest, name)
      type(pinned_t), intent(in) :: pinned
      type(first_block_t), intent(in) :: beside
      real(wp), intent(in) :: lowest(:, :)
      character(len=*), intent(in) :: name
      real(wp), allocatable :: applied(:, :)
      type(error_t), allocatable :: error

      if (.not. allocated(beside%applied)) return
      call check_orthonormal(beside%vectors, 1.0e-13_wp, name//': beside, orthonormal')
      call tally%check(all(abs(matmul(transpose(lowest), beside%vectors)) <= 1.0e-6_wp), name//': beside, apart from the lowest')
      applied = beside%vectors
      call apply_inverse(pinned, applied, error)
      call tally%check(all(abs(applied - beside%applied) <= 1.0e-10_wp*maxval(abs(applied))), name//': beside, applied')
   end subroutine check_beside

   !> What was made of vectors that are far from orthogonal to the lowest is not used.
   subroutine check_misled(a, pinned, beside, lowest, expected, name)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(first_block_t), intent(in) :: beside
      real(wp), intent(in) :: lowest(:, :), expected
      character(len=*), intent(in) :: name
      type(first_block_t) :: wrong

      if (.not. allocated(beside%applied) .or. size(lowest, 2) == 0) return
      wrong = beside
      wrong%vectors(:, 1) = 0.6_wp*wrong%vectors(:, 1) + 0.8_wp*lowest(:, 1)
      wrong%applied = 0.0_wp
      call check_next(a, pinned, lowest, [expected], 1.0e-12_wp, name//', misled', wrong)
   end subroutine check_misled

   !> Beside what the pins hold though it is no zero.
   subroutine find_left(a, pinned, held, wanted, left, name)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in) :: held(:, :)
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: left(:, :)
      character(len=*), intent(in) :: name
      type(error_t), allocatable :: error

      call left_null_space(a, pinned, held, wanted, left, error)
      call tally%check(.not. allocated(error) .and. size(left, 2) == wanted, name//': left')
      call check_orthonormal(left, 1.0e-13_wp, name//': left, orthonormal')
      call tally%check(all(abs(product_with(a%by_row, left)) <= 1.0e-13_wp), name//': what A'' leaves')
   end subroutine find_left

   !> With one pin less than there are zeros the factorisation must fail, with as
   !> many at the right places it must not.
   subroutine too_few_pins(name, n)
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp) :: u(n, n), v(n, n), s(n)
      type(operator_t) :: a
      type(pinned_t) :: pinned
      logical :: is_pinned(n)
      type(error_t), allocatable :: error

      s = 1.0_wp
      s(:2) = 0.0_wp
      u = random_orthogonal(n)
      v = random_orthogonal(n)
      a = operator_of(sparse_of(matmul(u*spread(s, 1, n), transpose(v))))
      call prove(a, 2, pinned, name)
      is_pinned = .false.
      is_pinned(pinned%pin(1)) = .true.
      call pin(is_pinned, pinned, error)
      call tally%check(is_kind(error, error_not_definite), name//': one pin is too few')
      call tally%check(pinned%failed >= 1 .and. pinned%failed <= n, name//': where it failed')
      is_pinned(pinned%failed) = .true.
      call pin(is_pinned, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 2, name//': a pin there fixes it')
      is_pinned = .true.
      call pin(is_pinned, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == n, name//': too many do no harm')
      call release(pinned)
      call release(pinned)
   end subroutine too_few_pins

   !> A value of t/2 counts as low, one of 2 t does not.
   subroutine too_few_pins_in_a_path()
      integer, parameter :: n = 60
      real(wp), allocatable :: left(:, :), right(:, :)
      real(wp) :: values(n), t
      type(sparse_t) :: matrix
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error
      integer :: k

      t = 0.0_wp
      do k = 0, 2
         values = 1.0_wp
         if (k > 0) values(n/2) = 0.25_wp*t*4**k/2
         call banded(values, matrix, left, right)
         a = operator_of(matrix)
         call factorise(a, pinned, error)
         t = pinned%least
         call pin(spread(.false., 1, n), pinned, error)
         call tally%check((.not. allocated(error)) .eqv. k /= 1, 'what is below t is seen')
         call release(pinned)
      end do
      call tally%check(t > 1.0e-7_wp .and. t < 1.0e-6_wp, 'where t is')
   end subroutine too_few_pins_in_a_path

   subroutine a_fixed_grid()
      integer, parameter :: n = 60
      real(wp), parameter :: lines(3) = 4*sin([1, 2, 3]*pi/(2*(n + 1)))**2
      type(operator_t) :: a
      type(pinned_t) :: pinned
      real(wp), allocatable :: left(:, :)
      real(wp) :: none(n**2, 0)
      type(error_t), allocatable :: error

      a = operator_of(grid(n, .false.))
      call factorise(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 0, 'grid: no pins')
      call check_next(a, pinned, none, sqrt([lines(1) + lines(1), lines(1) + lines(2), lines(1) + lines(2), &
                                             lines(2) + lines(2)]), 1.0e-10_wp, 'grid')
      call check_left(a, pinned, 5, 'grid', left)
      call release(pinned)
   end subroutine a_fixed_grid

   subroutine a_torus()
      integer, parameter :: n = 50
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(first_block_t) :: beside
      real(wp), allocatable :: vectors(:, :), left(:, :)
      real(wp) :: values(1)

      a = operator_of(grid(n, .true.))
      call prove(a, 1, pinned, 'torus')
      call find_low(a, pinned, vectors, values, beside)
      call tally%near(values, [0.0_wp], 1.0e-13_wp, 'torus: one zero')
      call tally%near(vectors(:, 1)/vectors(1, 1), spread(1.0_wp, 1, n**2), 1.0e-11_wp, 'torus: its vector')
      call check_next(a, pinned, vectors, spread(2*sin(pi/n), 1, 4), 1.0e-10_wp, 'torus')
      call check_left(a, pinned, 5, 'torus', left)
      call release(pinned)
   end subroutine a_torus

   !> Also where the factor is narrow; the column with the small pivot is marked.
   subroutine shifting_a_ring()
      integer, parameter :: n = 60
      type(operator_t) :: a
      type(pinned_t) :: pinned
      real(wp) :: x(n, 1)
      type(error_t), allocatable :: error

      a = operator_of(path(n, .true.))
      call factorise(a, pinned, error)
      call shift_and_mark(pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%is_shifted, 'ring: shifted')
      call tally%check(pinned%pins == 1, 'ring: marked')
      call random_number(x)
      call apply_inverse(pinned, x, error)
      call tally%near(x(:, 1)/x(1, 1), spread(1.0_wp, 1, n), 1.0e-8_wp, 'ring: the null vector')
      call seek_pins(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 1, 'ring: and the pin that holds it')
      call release(pinned)
   end subroutine shifting_a_ring

   !> What A leaves is short, since t**2 is added to squares of 1.
   subroutine shifting_brings_forth_the_null_space()
      integer, parameter :: n = 90
      real(wp) :: u(n, n), v(n, n), s(n), x(n, 1)
      type(operator_t) :: a
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error

      s = 1.0_wp
      s(n) = 0.0_wp
      u = random_orthogonal(n)
      v = random_orthogonal(n)
      a = operator_of(sparse_of(matmul(u*spread(s, 1, n), transpose(v))))
      call factorise(a, pinned, error)
      call shift(pinned, error)
      call tally%check(.not. allocated(error), 'shifted')
      call random_number(x)
      call apply_inverse(pinned, x, error)
      x = x/norm2(x)
      call tally%near(abs([dot_product(x(:, 1), v(:, n))]), [1.0_wp], 1.0e-10_wp, 'the null vector')
      call seek_pins(a, pinned, error)
      call tally%check(.not. allocated(error) .and. pinned%pins == 1, 'and the pin that holds it')
      call release(pinned)
   end subroutine shifting_brings_forth_the_null_space

   subroutine memory_that_does_not_suffice()
      type(pinned_t) :: pinned
      type(error_t), allocatable :: error

      call factorise(operator_of(grid(80, .false.)), pinned, error, 1000.0_wp)
      call tally%check(is_kind(error, error_memory) .and. pinned%bytes > 8*80**2, 'what is needed is reported')
      call release(pinned)
   end subroutine memory_that_does_not_suffice
end program test_pinned
