! SPDX-License-Identifier: BSD-3-Clause
!> Random sparse symmetric matrices of all kinds that a factorisation may meet, each made again
!> from a seed and a number.
module flexact_random_patterns
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_cholesky_oracle, only: lower_t
   use flexact_kinds, only: wp
   implicit none
   private
   public :: draw_t, draw_small, draw_larger

   type :: draw_t
      !> An order counts from 0.
      integer, allocatable :: order(:)
      type(lower_t) :: lower
      integer :: threads = 1
      !> Whether nothing rounds, wherever elimination has not failed before.
      logical :: is_exact = .false.
      integer(int64) :: state = 0
   end type draw_t

   integer, parameter :: shape_any = 0, shape_tree = 1, shape_band = 2, shape_stars = 3, shape_cliques = 4
   integer, parameter :: shapes = 5
   integer, parameter :: kind_safe = 0, kind_graded = 1, kind_gram = 2, kind_near = 3, kind_whole = 4
   integer, parameter :: kinds = 8

contains

   !> Up to 12 columns.
   subroutine draw_small(seed, number, draw)
      integer(int64), intent(in) :: seed, number
      type(draw_t), intent(out) :: draw
      integer, parameter :: most = 12
      logical :: is_there(most, most)
      real(wp) :: dense(most, most)
      integer :: n

      draw%state = begin(seed, number)
      n = 1 + below(draw, most)
      draw%threads = merge(2, 1, below(draw, 64) == 0)
      call draw_matrix(draw, n, is_there(:n, :n), dense(:n, :n))
      call pack_lower(draw, n, is_there(:n, :n), dense(:n, :n))
   end subroutine draw_small

   !> 13 columns or more; the larger the fewer.
   subroutine draw_larger(seed, number, draw)
      integer(int64), intent(in) :: seed, number
      type(draw_t), intent(out) :: draw
      logical, allocatable :: is_there(:, :)
      real(wp), allocatable :: dense(:, :)
      integer :: n

      draw%state = begin(seed, -number)
      n = int(13*exp(3.6_wp*chance(draw)))
      draw%threads = 1 + below(draw, 2)
      allocate (is_there(n, n), dense(n, n))
      call draw_matrix(draw, n, is_there, dense)
      call pack_lower(draw, n, is_there, dense)
   end subroutine draw_larger

   !> Far apart for all seeds and numbers.
   pure integer(int64) function begin(seed, number)
      integer(int64), intent(in) :: seed, number
      integer :: i

      begin = ieor(ishft(seed, 40), number) + 88172645463325252_int64
      do i = 1, 8
         begin = next(ieor(begin, ishftc(begin, 7*i)))
      end do
   end function begin

   !> xorshift (Marsaglia, J. Stat. Softw. 8(14), 2003).
   pure integer(int64) function next(state)
      integer(int64), intent(in) :: state
      next = ieor(state, ishft(state, 13))
      next = ieor(next, ishft(next, -7))
      next = ieor(next, ishft(next, 17))
      if (next == 0) next = 1
   end function next

   !> 0 or more, below 1.
   real(wp) function chance(draw)
      type(draw_t), intent(inout) :: draw
      draw%state = next(draw%state)
      chance = real(ishft(draw%state, -11), wp)*2.0_wp**(-53)
   end function chance

   !> 0 to n - 1.
   integer function below(draw, n)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      below = min(n - 1, int(n*chance(draw)))
   end function below

   subroutine draw_matrix(draw, n, is_there, dense)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      logical, intent(out) :: is_there(:, :)
      real(wp), intent(out) :: dense(:, :)
      integer :: kind

      call draw_order(draw, n)
      kind = below(draw, kinds)
      if (kind == kind_gram .or. kind == kind_near) then
         call draw_gram(draw, n, kind == kind_near, is_there, dense)
         return
      end if
      call draw_shape(draw, n, is_there)
      if (kind == kind_whole) then
         draw%is_exact = .true.
         call draw_whole(draw, n, is_there, dense)
      else
         call draw_values(draw, n, kind, is_there, dense)
      end if
   end subroutine draw_matrix

   subroutine draw_order(draw, n)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      integer :: i, k, kept

      draw%order = [(i - 1, i=1, n)]
      if (below(draw, 4) == 0) return
      do i = n, 2, -1
         k = 1 + below(draw, i)
         kept = draw%order(k)
         draw%order(k) = draw%order(i)
         draw%order(i) = kept
      end do
   end subroutine draw_order

   !> The lower triangle of a pattern.
   subroutine draw_shape(draw, n, is_there)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      logical, intent(out) :: is_there(:, :)
      integer :: i, j, shape, width
      real(wp) :: share

      shape = below(draw, shapes)
      share = chance(draw)**2*merge(1.0_wp, 20.0_wp/n, n <= 20)
      width = 1 + below(draw, min(n, 20))
      is_there = .false.
      do j = 1, n
         is_there(j, j) = .true.
         do i = j + 1, n
            select case (shape)
            case (shape_any, shape_tree)
               is_there(i, j) = chance(draw) < share
            case (shape_band)
               is_there(i, j) = i - j <= width .and. chance(draw) < 0.9_wp
            case (shape_stars)
               is_there(i, j) = modulo(i, width + 1) == 0 .and. chance(draw) < 0.7_wp
            case (shape_cliques)
               is_there(i, j) = i/(width + 1) == j/(width + 1) .or. chance(draw) < 0.3_wp/n
            end select
         end do
         if (shape == shape_tree .and. j < n) is_there(j + 1:, j) = .false.
         if (shape == shape_tree .and. j < n) is_there(j + 1 + below(draw, n - j), j) = .true.
      end do
   end subroutine draw_shape

   !> Definite by its diagonal; or graded; or of any sign, which is seldom definite.
   subroutine draw_values(draw, n, kind, is_there, dense)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n, kind
      logical, intent(in) :: is_there(:, :)
      real(wp), intent(out) :: dense(:, :)
      real(wp) :: grade(n), share
      integer :: i, j

      do j = 1, n
         grade(j) = merge(10.0_wp**(12*chance(draw) - 6), 1.0_wp, kind == kind_graded)
      end do
      share = merge(0.9_wp*chance(draw), 1.01_wp, kind > kind_whole)
      dense = 0.0_wp
      do j = 1, n
         do i = j + 1, n
            if (is_there(i, j)) dense(i, j) = 2*chance(draw) - 1
            if (is_there(i, j) .and. below(draw, 20) == 0) dense(i, j) = 0.0_wp
         end do
      end do
      do j = 1, n
         dense(j, j) = share*(sum(abs(dense(j, :j - 1))) + sum(abs(dense(j + 1:, j)))) + 0.01_wp*chance(draw)
      end do
      do j = 1, n
         dense(j:, j) = dense(j:, j)*grade(j:)*grade(j)
      end do
   end subroutine draw_values

   !> A'A of a sparse A: as it is with many rows; singular with few, then made definite by ones on
   !> its diagonal, less a little of it, as pins do, or hardly.
   subroutine draw_gram(draw, n, is_near, is_there, dense)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      logical, intent(in) :: is_near
      logical, intent(out) :: is_there(:, :)
      real(wp), intent(out) :: dense(:, :)
      integer :: row, rows, k, a, b, place(6), length
      real(wp) :: value(6), shift

      is_there = .false.
      dense = 0.0_wp
      rows = 1 + below(draw, 3*n)
      do row = 1, rows
         length = 1 + below(draw, 6)
         do k = 1, length
            place(k) = 1 + below(draw, n)
            value(k) = 2*chance(draw) - 1
            if (is_near) value(k) = below(draw, 5) - 2
         end do
         do a = 1, length
            do b = 1, length
               if (place(a) < place(b)) cycle
               is_there(place(a), place(b)) = .true.
               dense(place(a), place(b)) = dense(place(a), place(b)) + value(a)*value(b)
            end do
         end do
      end do
      shift = merge(10.0_wp**(-10 - below(draw, 7)), 1.0e-3_wp, is_near)*merge(1.0_wp, -1.0_wp, below(draw, 2) == 0)
      do k = 1, n
         is_there(k, k) = .true.
         if (below(draw, 3) == 0) dense(k, k) = dense(k, k) + 1.0_wp
         dense(k, k) = dense(k, k) + shift
      end do
   end subroutine draw_gram

   !> L L' of whole numbers in the order of elimination, so that nothing rounds; now and then with
   !> pivots that are zero.
   subroutine draw_whole(draw, n, is_there, dense)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      logical, intent(in) :: is_there(:, :)
      real(wp), intent(out) :: dense(:, :)
      real(wp) :: l(n, n)
      integer :: i, j, k, zeros

      l = 0.0_wp
      zeros = merge(n, 2*n + 1, below(draw, 2) == 0)
      do j = 1, n
         l(j, j) = 2.0_wp**below(draw, 3)
         if (below(draw, zeros) == 0) l(j, j) = 0.0_wp
         do i = j + 1, n
            if (is_there(i, j)) l(i, j) = below(draw, 5) - 2
         end do
      end do
      dense = 0.0_wp
      do k = 1, n
         do j = k, n
            if (abs(l(j, k)) > 0) dense(j:, j) = dense(j:, j) + l(j:, k)*l(j, k)
         end do
      end do
      do k = 1, n
         draw%order(k) = k - 1
      end do
   end subroutine draw_whole

   !> Column by column, the diagonal first; whatever is not zero is there.
   subroutine pack_lower(draw, n, is_there, dense)
      type(draw_t), intent(inout) :: draw
      integer, intent(in) :: n
      logical, intent(in) :: is_there(:, :)
      real(wp), intent(in) :: dense(:, :)
      integer :: i, j, entry, entries

      associate (a => draw%lower)
         a%n = n
         entries = n
         do j = 1, n
            entries = entries + count(is_there(j + 1:, j) .or. abs(dense(j + 1:, j)) > 0)
         end do
         allocate (a%start(n + 1), a%place(entries), a%value(entries))
         entry = 0
         a%start(1) = 0
         do j = 1, n
            do i = j, n
               if (i > j .and. .not. (is_there(i, j) .or. abs(dense(i, j)) > 0)) cycle
               entry = entry + 1
               a%place(entry) = i - 1
               a%value(entry) = dense(i, j)
            end do
            a%start(j + 1) = entry
         end do
      end associate
   end subroutine pack_lower
end module flexact_random_patterns
