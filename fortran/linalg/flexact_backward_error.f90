! SPDX-License-Identifier: BSD-3-Clause
!> By how much, in the 2-norm, the product L L' of a Cholesky factorisation that ran to
!> its end may differ from A'A and what was added to its diagonal.
!>
!> Whatever the order of the operations, a sum of k products is off by at most g(k), k
!> roundings, times the sum of their magnitudes (Higham, Accuracy and Stability of
!> Numerical Algorithms, 2002, lemma 8.4, theorem 10.3). So are the entries of A'A, where
!> k counts the rows that two columns share, and those of L L', where k counts
!> the columns in which two rows of L both have entries: at most min(k_i, k_j), the
!> numbers of entries of rows i and j; zeros cost no rounding. As g of the
!> minimum is at most the root of g(k_i) g(k_j), the error has a norm of at most that of
!> W |L| |L'| W, W = diag(root of g(k_i)). Of this matrix, which is not negative, the
!> norm is at most the largest quotient of the entries of its product with x and those of
!> x, for any positive x (Collatz, Math. Z. 48, 1942); theory.md (32) and (33), with what
!> they leave out.
module flexact_backward_error
   use flexact_cholesky, only: cholesky_t
   use flexact_kinds, only: wp, long
   use flexact_skyline, only: skyline_t
   use flexact_sparse, only: operator_t
   use flexact_supernodal_pattern, only: columns_in, rows_in
   implicit none
   private
   public :: error_of_gram, error_of_skyline, error_of_cholesky, unit, extra

   real(wp), parameter :: unit = 0.5_wp*epsilon(1.0_wp)
   !> Roundings of an entry beside those of its products: a division as a product
   !> with the inverse, a root, what was added, and one for the bound itself.
   integer, parameter :: extra = 4
   !> Products with x: the first is with a guess, the second nearly as good as many.
   integer, parameter :: rounds = 2

contains

   !> Of k roundings, relative to the sum of magnitudes.
   pure elemental real(wp) function growth(k)
      integer, intent(in) :: k
      growth = k*unit/(1 - k*unit)
   end function growth

   !> For A'A with ones or less added to its diagonal. largest: entry of that. enough: no
   !> better bound than this is sought.
   pure real(wp) function error_of_gram(a, largest, enough) result(bound)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: largest, enough
      real(wp) :: w(a%by_column%columns), x(a%by_column%columns), z(a%by_column%columns), y(a%by_column%rows)
      integer :: j, round

      w = growth(a%by_column%start(2:) - a%by_column%start(:a%by_column%columns) + extra)
      x = sqrt(w)
      bound = huge(bound)
      do round = 1, rounds
         y = 0.0_wp
         do j = 1, size(x)
            associate (from => a%by_column%start(j), to => a%by_column%start(j + 1) - 1)
               y(a%by_column%place(from:to)) = y(a%by_column%place(from:to)) + abs(a%by_column%value(from:to))*x(j)
            end associate
         end do
         do j = 1, size(x)
            associate (from => a%by_column%start(j), to => a%by_column%start(j + 1) - 1)
               z(j) = w(j)*dot_product(abs(a%by_column%value(from:to)), y(a%by_column%place(from:to)))
            end associate
         end do
         bound = min(bound, maxval(z/x))
         if (bound <= enough) exit
         x = z + max(tiny(1.0_wp), epsilon(1.0_wp)*maxval(z))
      end do
      bound = bound + growth(extra)*(1 + largest)
   end function error_of_gram

   !> enough: no better bound than this is sought.
   pure real(wp) function error_of_skyline(l, enough) result(bound)
      type(skyline_t), intent(in) :: l
      real(wp), intent(in) :: enough
      real(wp) :: w(l%n), x(l%n), y(l%n), z(l%n)
      integer :: i, round

      w = growth([(i - l%first(i) + 1 + extra, i=1, l%n)])
      x = sqrt(w)
      bound = huge(bound)
      do round = 1, rounds
         y = 0.0_wp
         do i = 1, l%n
            associate (row => l%value(l%base(i) + l%first(i):l%base(i) + i))
               y(l%first(i):i) = y(l%first(i):i) + abs(row)*x(i)
            end associate
         end do
         do i = 1, l%n
            z(i) = w(i)*dot_product(abs(l%value(l%base(i) + l%first(i):l%base(i) + i)), y(l%first(i):i))
         end do
         bound = min(bound, maxval(z/x))
         if (bound <= enough) exit
         x = z
      end do
   end function error_of_skyline

   !> Infinite where memory does not suffice. enough: no better bound than this is sought.
   real(wp) function error_of_cholesky(factor, enough) result(bound)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: enough
      real(wp), allocatable :: w(:), x(:), z(:), from(:), to(:)
      integer :: round, info

      bound = huge(bound)
      if (factor%n == 0) bound = 0.0_wp
      if (factor%n == 0) return
      allocate (w(factor%n), x(factor%n), z(factor%n), from(factor%widest), to(factor%widest), stat=info)
      if (info /= 0) return
      call count_in_rows(factor, w)
      w = (w + extra)*unit
      w = w/(1 - w)
      x = sqrt(w)
      do round = 1, rounds
         call multiply_twice(factor, x, from, to, z)
         z = w*z
         bound = min(bound, maxval(z/x))
         if (.not. all(z <= huge(bound))) bound = huge(bound)
         if (bound <= enough) exit
         x = z
      end do
   end function error_of_cholesky

   !> Entries of L in each of its rows, zeros that pad a supernode with them.
   pure subroutine count_in_rows(factor, count)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(out) :: count(:)
      integer :: s, i

      count = 0.0_wp
      associate (pattern => factor%pattern)
         do s = 1, pattern%supernodes
            do i = 1, rows_in(pattern, s)
               associate (row => pattern%row(pattern%rows_from(s) + i - 1))
                  count(row) = count(row) + min(i, columns_in(pattern, s))
               end associate
            end do
         end do
      end associate
   end subroutine count_in_rows

   !> z = |L| |L'| x.
   pure subroutine multiply_twice(factor, x, from, to, z)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: from(:), to(:)
      real(wp), intent(out) :: z(:)
      integer :: s, i, rows

      z = 0.0_wp
      associate (pattern => factor%pattern)
         do s = 1, pattern%supernodes
            rows = rows_in(pattern, s)
            associate (row => pattern%row(pattern%rows_from(s):pattern%rows_from(s + 1) - 1))
               do i = 1, rows
                  from(i) = x(row(i))
               end do
               call multiply_panel(rows, columns_in(pattern, s), factor%value(pattern%panel(s)), from, to)
               do i = 1, rows
                  z(row(i)) = z(row(i)) + to(i)
               end do
            end associate
         end do
      end associate
   end subroutine multiply_twice

   pure subroutine multiply_panel(rows, columns, panel, from, to)
      integer, intent(in) :: rows, columns
      real(wp), intent(in) :: panel(rows, columns), from(rows)
      real(wp), intent(out) :: to(rows)
      real(wp) :: total
      integer :: j

      to = 0.0_wp
      do j = 1, columns
         total = sum_of_products(rows - j + 1, panel(j:, j), from(j:))
         to(j:) = to(j:) + abs(panel(j:, j))*total
      end do
   end subroutine multiply_panel

   !> Four sums side by side, which the processor adds at once.
   pure real(wp) function sum_of_products(n, a, x) result(total)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(n), x(n)
      real(wp) :: part(4)
      integer :: i

      part = 0.0_wp
      do i = 1, n - 3, 4
         part = part + abs(a(i:i + 3))*x(i:i + 3)
      end do
      total = sum(part)
      do i = n - mod(n, 4) + 1, n
         total = total + abs(a(i))*x(i)
      end do
   end function sum_of_products
end module flexact_backward_error
