! SPDX-License-Identifier: BSD-3-Clause
!> A'A of several small sparse matrices of one pattern, side by side in lanes, and whether all
!> singular values are above a bound, by one Cholesky factorisation; theory.md (48). The order and
!> the pattern of the factor are found once for all of them.
module flexact_gram_lanes
   use flexact_kinds, only: wp, lanes
   use flexact_sparse, only: sparse_t, compress
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   implicit none
   private
   public :: gram_pattern_t, make_gram_pattern, make_gram, traces_of, find_above, shift_of, spread_gram

   real(wp), parameter :: unit = 0.5_wp*epsilon(1.0_wp)
   !> Roundings beside those of the products: roots, divisions, what is subtracted, the bound.
   integer, parameter :: extra = 10

   !> Sums of products: entry t is that of pairs start(t) to start(t + 1) - 1.
   type :: products_t
      integer, allocatable :: start(:), pair(:, :)
   end type products_t

   !> Of A'A, or A A' if that is smaller: the entries of its factor column by column in the order
   !> of elimination, the diagonal first in each.
   type :: gram_pattern_t
      integer :: side = 0
      !> Rows and columns of A together.
      integer :: terms = 0
      !> Where each column begins, (side + 1).
      integer, allocatable :: start(:)
      !> Row and column of A'A that each entry is, (2, entries).
      integer, allocatable :: place(:, :)
      !> Of entries of A; and of entries of the factor, to be subtracted.
      type(products_t) :: of_gram, of_factor
   end type gram_pattern_t

contains

   !> Entries of A, (rows, columns), stand in these rows and columns; those with a zero in either
   !> are none of it.
   pure subroutine make_gram_pattern(rows, columns, row, column, pattern)
      integer, intent(in) :: rows, columns, row(:), column(:)
      type(gram_pattern_t), intent(out) :: pattern
      type(sparse_t) :: line
      type(symmetric_pattern_t) :: factor
      integer :: number(min(rows, columns), min(rows, columns)), e

      pattern%side = min(rows, columns)
      pattern%terms = rows + columns
      ! Its values are the numbers of the entries.
      if (columns == pattern%side) then
         call compress(columns, rows, column, row, [(real(e, wp), e=1, size(row))], line)
      else
         call compress(rows, columns, row, column, [(real(e, wp), e=1, size(row))], line)
      end if
      call analyse_pattern(pattern_of_products(line), factor)
      call number_entries(factor, pattern, number)
      call find_products_of_gram(line, number, size(pattern%place, 2), pattern%of_gram)
      call find_products_of_factor(factor, number, size(pattern%place, 2), pattern%of_factor)
   end subroutine make_gram_pattern

   !> The lower triangle of what the entries of each line, a column here, have with each other.
   pure function pattern_of_products(line) result(gram)
      type(sparse_t), intent(in) :: line
      type(sparse_t) :: gram
      logical :: joined(line%rows, line%rows)
      integer :: i, j

      joined = .false.
      do j = 1, line%columns
         associate (met => line%place(line%start(j):line%start(j + 1) - 1))
            joined(met, met) = .true.
         end associate
      end do
      do j = 1, line%rows
         joined(:j, j) = .false.
         joined(j, j) = .true.
      end do
      associate (entries => count(joined), all => spread([(i, i=1, line%rows)], 2, line%rows))
         call compress(line%rows, line%rows, pack(all, joined), pack(transpose(all), joined), [(1.0_wp, i=1, entries)], gram)
      end associate
   end function pattern_of_products

   !> number: of each entry by its row and column in A'A, either way round.
   pure subroutine number_entries(factor, pattern, number)
      type(symmetric_pattern_t), intent(in) :: factor
      type(gram_pattern_t), intent(inout) :: pattern
      integer, intent(out) :: number(:, :)
      integer, allocatable :: column(:)
      integer :: j, k, t

      number = 0
      t = 0
      allocate (pattern%start(factor%n + 1), pattern%place(2, size(factor%place) + factor%n))
      do j = 1, factor%n
         pattern%start(j) = t + 1
         column = factor%order([j, factor%place(factor%start(j):factor%start(j + 1) - 1)])
         do k = 1, size(column)
            t = t + 1
            pattern%place(:, t) = [column(k), column(1)]
            number(column(k), column(1)) = t
            number(column(1), column(k)) = t
         end do
      end do
      pattern%start(factor%n + 1) = t + 1
   end subroutine number_entries

   pure subroutine find_products_of_gram(line, number, entries, products)
      type(sparse_t), intent(in) :: line
      integer, intent(in) :: number(:, :), entries
      type(products_t), intent(out) :: products
      integer :: next(entries), j, a, b, pass

      next = 0
      do pass = 1, 2
         do j = 1, line%columns
            do b = line%start(j), line%start(j + 1) - 1
               do a = line%start(j), b
                  call offer(number(line%place(a), line%place(b)), nint(line%value([a, b])), pass == 2, next, products)
               end do
            end do
         end do
         if (pass == 1) call open_lists(next, products)
      end do
   end subroutine find_products_of_gram

   pure subroutine find_products_of_factor(factor, number, entries, products)
      type(symmetric_pattern_t), intent(in) :: factor
      integer, intent(in) :: number(:, :), entries
      type(products_t), intent(out) :: products
      integer :: next(entries), j, q, p, pass

      next = 0
      do pass = 1, 2
         do j = 1, factor%n
            do q = factor%left_start(j), factor%left_start(j + 1) - 1
               associate (k => factor%left_column(q), order => factor%order)
                  do p = factor%left_entry(q), factor%start(k + 1) - 1
                     associate (i => factor%place(p))
                        call offer(number(order(i), order(j)), [number(order(i), order(k)), number(order(j), order(k))], &
                                   pass == 2, next, products)
                     end associate
                  end do
               end associate
            end do
         end do
         if (pass == 1) call open_lists(next, products)
      end do
   end subroutine find_products_of_factor

   !> Count a pair of entry t, or put it down.
   pure subroutine offer(t, pair, is_kept, next, products)
      integer, intent(in) :: t, pair(2)
      logical, intent(in) :: is_kept
      integer, intent(inout) :: next(:)
      type(products_t), intent(inout) :: products

      if (is_kept) products%pair(:, next(t)) = pair
      next(t) = next(t) + 1
   end subroutine offer

   !> Make room for so many pairs of each entry.
   pure subroutine open_lists(next, products)
      integer, intent(inout) :: next(:)
      type(products_t), intent(inout) :: products
      integer :: t

      allocate (products%start(size(next) + 1))
      products%start(1) = 1
      do t = 1, size(next)
         products%start(t + 1) = products%start(t) + next(t)
      end do
      next = products%start(:size(next))
      allocate (products%pair(2, products%start(size(next) + 1) - 1))
   end subroutine open_lists

   !> a (lanes, entries of A), gram (lanes, entries).
   pure subroutine make_gram(pattern, a, gram)
      type(gram_pattern_t), intent(in) :: pattern
      real(wp), intent(in), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: gram(:, :)
      real(wp) :: total(lanes)
      integer :: t, p

      associate (start => pattern%of_gram%start, pair => pattern%of_gram%pair)
         do t = 1, size(gram, 2)
            total = 0.0_wp
            do p = start(t), start(t + 1) - 1
               total = total + a(:lanes, pair(1, p))*a(:lanes, pair(2, p))
            end do
            gram(:lanes, t) = total
         end do
      end associate
   end subroutine make_gram

   !> The lower triangles of A'A as dense matrices, (lanes, side, side); the upper ones are left.
   pure subroutine spread_gram(pattern, gram, dense)
      type(gram_pattern_t), intent(in) :: pattern
      real(wp), intent(in), contiguous :: gram(:, :)
      real(wp), intent(inout), contiguous :: dense(:, :, :)
      integer :: j, t

      do j = 1, pattern%side
         dense(:, j:pattern%side, j) = 0.0_wp
      end do
      do t = 1, size(gram, 2)
         dense(:lanes, maxval(pattern%place(:, t)), minval(pattern%place(:, t))) = gram(:lanes, t)
      end do
   end subroutine spread_gram

   !> The sum of all squares of A.
   pure function traces_of(pattern, gram) result(traces)
      type(gram_pattern_t), intent(in) :: pattern
      real(wp), intent(in) :: gram(:, :)
      real(wp) :: traces(lanes)
      integer :: j

      traces = 0.0_wp
      do j = 1, pattern%side
         traces = traces + gram(:lanes, pattern%start(j))
      end do
   end function traces_of

   !> Whether no singular value is below `least`, in each lane; theory.md (48). gram: by make_gram.
   pure subroutine find_above(pattern, gram, least, above)
      type(gram_pattern_t), intent(in) :: pattern
      real(wp), intent(in), contiguous :: gram(:, :)
      real(wp), intent(in) :: least(lanes)
      logical, intent(out) :: above(lanes)
      real(wp) :: factor(lanes, size(gram, 2))
      real(wp), dimension(lanes) :: shift, total, inverse
      integer :: j, t, p

      above = pattern%side > 0
      inverse = 0.0_wp
      shift = shift_of(least, pattern%terms, traces_of(pattern, gram))
      associate (start => pattern%of_factor%start, pair => pattern%of_factor%pair)
         do j = 1, pattern%side
            do t = pattern%start(j), pattern%start(j + 1) - 1
               total = gram(:lanes, t)
               if (t == pattern%start(j)) total = total - shift
               do p = start(t), start(t + 1) - 1
                  total = total - factor(:, pair(1, p))*factor(:, pair(2, p))
               end do
               if (t == pattern%start(j)) then
                  above = above .and. total > 0
                  total = sqrt(max(total, tiny(1.0_wp)))
                  inverse = 1/total
                  factor(:, t) = total
               else
                  factor(:, t) = inverse*total
               end if
            end do
         end do
      end associate
   end subroutine find_above

   !> That the factorisation of A'A - s I runs to its end shows that no singular value of A is
   !> below `least`, if s is the square of that and what rounding may make: the sums of k
   !> products of A'A and of the factor are off by at most k roundings times sums of magnitudes,
   !> together no more than (rows + columns, `terms`) roundings times the sum of all squares of A
   !> (Higham, Accuracy and Stability of Numerical Algorithms, 2002, lemma 8.4 and theorem
   !> 10.3; Rump, BIT 46, 2006).
   elemental real(wp) function shift_of(least, terms, squares) result(shift)
      real(wp), intent(in) :: least, squares
      integer, intent(in) :: terms
      shift = (least**2 + (terms + extra)*unit*squares)*(1 + extra*unit)
   end function shift_of
end module flexact_gram_lanes
