! SPDX-License-Identifier: BSD-3-Clause
!> What sparse rows leave free, and the vectors and multipliers of least norm.
program test_row_space
   use flexact_decomposition, only: decompose
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_row_space, only: row_space_t, analyse_rows, find_multipliers, follow_rows
   use flexact_sparse, only: sparse_t
   use flexact_test_matrices, only: identity, sparse_of, dense_of, path, random_orthogonal
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call no_rows()
   call no_columns()
   call a_zero_row()
   call a_ring_of_differences()
   call components_of_any_rank()
   call rows_that_nearly_depend()
   call chains()
   call tally%finish()

contains

   subroutine analyse(dense, space)
      real(wp), intent(in) :: dense(:, :)
      type(row_space_t), intent(out) :: space
      type(error_t), allocatable :: error

      call analyse_rows(sparse_of(dense), space, error)
      call tally%check(.not. allocated(error), 'rows were analysed')
   end subroutine analyse

   subroutine no_rows()
      type(row_space_t) :: space
      real(wp) :: none(0, 4), x(4, 1), mismatch(1)

      call analyse(none, space)
      call tally%near([dense_of(space%basis)], [identity(4)], 0.0_wp, 'each column is free')
      call follow_rows(space, reshape([real(wp) ::], [0, 1]), x, mismatch)
      call tally%near([x, mismatch], spread(0.0_wp, 1, 5), 0.0_wp, 'nothing to follow')
   end subroutine no_rows

   subroutine no_columns()
      type(row_space_t) :: space
      real(wp) :: none(3, 0), l(3, 1)

      call analyse(none, space)
      call tally%check(space%dependent == 3 .and. space%basis%columns == 0, 'rows of nothing depend')
      call find_multipliers(space, reshape([real(wp) ::], [0, 1]), l)
      call tally%near([l], spread(0.0_wp, 1, 3), 0.0_wp, 'their multipliers are zero')
   end subroutine no_columns

   subroutine a_zero_row()
      type(row_space_t) :: space
      real(wp) :: rows(2, 2), x(2, 1), mismatch(1)

      rows = 0.0_wp
      rows(1, 1) = 4.0_wp
      call analyse(rows, space)
      call tally%check(space%dependent == 1, 'a zero row depends')
      call follow_rows(space, reshape([8.0_wp, 6.0_wp], [2, 1]), x, mismatch)
      call tally%near([x, mismatch], [2.0_wp, 0.0_wp, 0.6_wp], 1.0e-15_wp, 'what it asks for is left out')
   end subroutine a_zero_row

   !> Differences along a ring: they sum up to zero, and leave one vector free.
   subroutine a_ring_of_differences()
      integer, parameter :: n = 12
      type(row_space_t) :: space
      real(wp) :: rows(n, n), l(n, 1), x(n, 1), c(n, 1), mismatch(1)

      rows = dense_of(path(n, .true.))
      call analyse(rows, space)
      call tally%check(space%dependent == 1 .and. space%basis%columns == 1, 'a ring has one of each')
      call tally%near(abs(space%basis%value), spread(1/sqrt(real(n, wp)), 1, n), 1.0e-14_wp, 'all alike are free')
      c = 0.0_wp
      c(3, 1) = 1.0_wp
      call find_multipliers(space, matmul(transpose(rows), c), l)
      c = c - 1.0_wp/n
      call tally%near([l], [c], 1.0e-14_wp, 'multipliers of least norm have no mean')
      call follow_rows(space, c + 1.0_wp, x, mismatch)
      call tally%near([matmul(rows, x)], [c], 1.0e-13_wp, 'what can be followed is')
      call tally%near([sum(x)], [0.0_wp], 1.0e-13_wp, 'by a vector of least norm')
      call tally%near(mismatch, [sqrt(n/(n + sum(c**2)))], 1.0e-13_wp, 'the rest is told')
   end subroutine a_ring_of_differences

   !> Blocks of random matrices on mixed rows and columns, against pseudoinverses.
   subroutine components_of_any_rank()
      integer, parameter :: m = 40, n = 36
      integer, parameter :: sizes(3, 5) = reshape([8, 6, 6, 10, 12, 7, 1, 3, 1, 12, 9, 5, 9, 5, 2], [3, 5])
      real(wp) :: rows(m, n)
      integer :: i, at(2), p(m), q(n)

      rows = 0.0_wp
      at = 0
      do i = 1, size(sizes, 2)
         rows(at(1) + 1:at(1) + sizes(1, i), at(2) + 1:at(2) + sizes(2, i)) = of_rank(sizes(1, i), sizes(2, i), sizes(3, i))
         at = at + sizes(:2, i)
      end do
      p = [(modulo(7*i, 41), i=1, m)]
      q = [(modulo(5*i, 37), i=1, n)]
      rows = rows(p, q)
      call compare_with_pseudoinverse(rows, m - sum(sizes(3, :)))
   end subroutine components_of_any_rank

   subroutine compare_with_pseudoinverse(rows, dependent)
      real(wp), intent(in) :: rows(:, :)
      integer, intent(in) :: dependent
      real(wp), dimension(size(rows, 2), 2) :: r, x
      real(wp), dimension(size(rows, 1), 2) :: c, l
      real(wp) :: inverse(size(rows, 2), size(rows, 1)), mismatch(2)
      type(row_space_t) :: space

      call analyse(rows, space)
      call tally%check(space%dependent == dependent, 'as many rows depend as must')
      call tally%check(space%basis%columns == size(rows, 2) - size(rows, 1) + dependent, 'as many vectors are free')
      associate (z => dense_of(space%basis))
         call tally%near([matmul(rows, z)], spread(0.0_wp, 1, size(rows, 1)*size(z, 2)), 1.0e-12_wp, 'J Z = 0')
         call tally%near([matmul(transpose(z), z)], [identity(size(z, 2))], 1.0e-14_wp, 'Z''Z = I')
      end associate
      inverse = pseudoinverse(rows)
      call random_number(r)
      call random_number(c)
      call find_multipliers(space, r, l)
      call tally%near([l], [matmul(transpose(inverse), r)], 1.0e-11_wp, 'multipliers')
      call follow_rows(space, c, x, mismatch)
      call tally%near([matmul(rows, x)], [matmul(rows, matmul(inverse, c))], 1.0e-11_wp, 'followed as far as can be')
      call tally%near([x], [matmul(inverse, matmul(rows, x))], 1.0e-11_wp, 'of least norm')
      call tally%near(mismatch*norm2(c, 1), norm2(c - matmul(rows, x), 1), 1.0e-11_wp, 'mismatch')
   end subroutine compare_with_pseudoinverse

   !> Random rows along a branched chain, so long that its columns are gathered in clusters. A few are
   !> sums of others, near to or far from each other.
   subroutine chains()
      integer, parameter :: nodes = 90, wide = 4, n = wide*nodes, each = 3, m = each*(nodes - 1) + 6
      real(wp) :: rows(m, n)
      integer :: k, from, i
      integer, parameter :: node(n) = [((i - 1)/wide + 1, i=1, n)]
      logical :: is_there(each, n)

      call random_number(rows)
      rows = rows - 0.5_wp
      do k = 2, nodes
         from = merge(k - 1, max(1, k - 31), modulo(k, 30) /= 1)
         is_there = spread(node == from .or. node == k, 1, each)
         where (.not. is_there) rows(each*(k - 2) + 1:each*(k - 1), :) = 0.0_wp
      end do
      do k = 1, 6
         rows(m - 6 + k, :) = rows(10*k, :) - 2*rows(merge(11*k, 40*k, modulo(k, 2) == 0), :)
      end do
      call compare_with_pseudoinverse(rows, 6)
   end subroutine chains

   function of_rank(m, n, rank) result(a)
      integer, intent(in) :: m, n, rank
      real(wp) :: a(m, n), left(m, m), right(n, n)
      integer :: i

      left = random_orthogonal(m)
      right = random_orthogonal(n)
      do i = 1, rank
         left(:, i) = i*left(:, i)
      end do
      a = matmul(left(:, :rank), right(:rank, :))
   end function of_rank

   function pseudoinverse(a) result(inverse)
      real(wp), intent(in) :: a(:, :)
      real(wp) :: inverse(size(a, 2), size(a, 1)), copy(size(a, 1), size(a, 2)), values(minval(shape(a)))
      real(wp) :: u(size(a, 1), size(a, 1)), vt(size(a, 2), size(a, 2))
      type(error_t), allocatable :: error
      integer :: k

      copy = a
      call decompose(copy, values, u, vt, error)
      do k = 1, size(values)
         u(:, k) = merge(u(:, k)/max(values(k), 1.0e-10_wp), 0.0_wp, values(k) > 1.0e-10_wp)
      end do
      inverse = matmul(transpose(vt(:size(values), :)), transpose(u(:, :size(values))))
   end function pseudoinverse

   !> Lengths do not matter, and what is left of a row decides.
   subroutine rows_that_nearly_depend()
      type(row_space_t) :: space
      real(wp) :: rows(2, 2)

      rows(1, :) = 1.0e9_wp*[1.0_wp, 0.0_wp]
      rows(2, :) = 1.0e-9_wp*[1.0_wp, 1.0e-7_wp]
      call analyse(rows, space)
      call tally%check(space%dependent == 0, 'independent')
      call tally%near([space%shortest], [1.0e-7_wp], 1.0e-15_wp, 'its rest')
      rows(2, 2) = 1.0e-20_wp
      call analyse(rows, space)
      call tally%check(space%dependent == 1, 'dependent')
   end subroutine rows_that_nearly_depend
end program test_row_space
