! SPDX-License-Identifier: BSD-3-Clause
!> Orders of elimination: they are permutations of any graph, and on a square grid they leave not
!> much more in the factor than the best that is known.
program test_nested_order
   use flexact_cholesky, only: cholesky_t, analyse
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_metis, only: metis_is_there, metis_order
   use flexact_nested_order, only: own_order
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   integer :: i

   call set_random()
   do i = 0, 60
      call a_random_graph(i, 3*i)
   end do
   call a_random_graph(400, 300)
   call a_random_graph(2000, 9000)
   call a_random_graph(700, 0)
   call all_joined(300)
   call a_star(500)
   call a_path(5000)
   call a_square(60, .true.)
   if (metis_is_there() /= 0) call a_square(60, .false.)
   call a_broad_cut(14)
   call hubs(1500, .true.)
   call hubs(1500, .false.)
   call a_star_of_arms(40000)
   call tally%finish()

contains

   subroutine check_order(name, n, start, place)
      character(len=*), intent(in) :: name
      integer, intent(in) :: n, start(:), place(:)
      integer :: order(n), widest, info

      call own_order(n, start, place, order, widest, info)
      call tally%check(info == 0 .and. is_permutation(order), name//': own')
      if (metis_is_there() == 0) return
      info = metis_order(n, start, place, order)
      call tally%check(info == 0 .and. is_permutation(order), name//': METIS')
   end subroutine check_order

   logical function is_permutation(order)
      integer, intent(in) :: order(:)
      logical :: is_met(size(order))
      integer :: i

      is_met = .false.
      is_permutation = all(order >= 0 .and. order < size(order))
      if (.not. is_permutation) return
      do i = 1, size(order)
         is_met(order(i) + 1) = .true.
      end do
      is_permutation = all(is_met)
   end function is_permutation

   !> A lower triangle from whether vertices are joined.
   subroutine lower(is_joined, start, place)
      logical, intent(in) :: is_joined(:, :)
      integer, allocatable, intent(out) :: start(:), place(:)
      integer :: i, j, n

      n = size(is_joined, 1)
      allocate (start(n + 1), source=0)
      allocate (place(count(is_joined)))
      do j = 1, n
         start(j + 1) = start(j)
         do i = j + 1, n
            if (.not. is_joined(i, j)) cycle
            start(j + 1) = start(j + 1) + 1
            place(start(j + 1)) = i - 1
         end do
      end do
   end subroutine lower

   subroutine a_random_graph(n, edges)
      integer, intent(in) :: n, edges
      logical :: is_joined(n, n)
      integer, allocatable :: start(:), place(:)
      real(wp) :: random(2)
      integer :: i

      is_joined = .false.
      do i = 1, edges
         call random_number(random)
         associate (a => 1 + int(n*random(1)), b => 1 + int(n*random(2)))
            is_joined(max(a, b), min(a, b)) = .true.
         end associate
      end do
      call lower(is_joined, start, place)
      call check_order('random', n, start, place)
   end subroutine a_random_graph

   subroutine all_joined(n)
      integer, intent(in) :: n
      logical :: is_joined(n, n)
      integer, allocatable :: start(:), place(:)

      is_joined = .true.
      call lower(is_joined, start, place)
      call check_order('all joined', n, start, place)
   end subroutine all_joined

   subroutine a_star(n)
      integer, intent(in) :: n
      logical :: is_joined(n, n)
      integer, allocatable :: start(:), place(:)

      is_joined = .false.
      is_joined(:, 1) = .true.
      call lower(is_joined, start, place)
      call check_order('star', n, start, place)
   end subroutine a_star

   subroutine a_path(n)
      integer, intent(in) :: n
      integer :: i

      call check_order('path', n, [(i, i=0, n - 1), n - 1], [(i, i=1, n - 1)])
   end subroutine a_path

   !> Neighbours by edges and corners of a cell. The best order known of a k x k grid leaves
   !> 31/4 k**2 log2(k) and some k**2 entries (George, SIAM J. Numer. Anal. 10, 1973).
   subroutine a_square(k, is_own)
      integer, intent(in) :: k
      logical, intent(in) :: is_own
      integer :: start(k*k + 1), place(4*k*k), order(k*k), info, widest, x, y, v, entry
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error

      entry = 0
      start(1) = 0
      do v = 0, k*k - 1
         x = mod(v, k)
         y = v/k
         if (x < k - 1) call add(v + 1, entry, place)
         if (y < k - 1 .and. x > 0) call add(v + k - 1, entry, place)
         if (y < k - 1) call add(v + k, entry, place)
         if (y < k - 1 .and. x < k - 1) call add(v + k + 1, entry, place)
         start(v + 2) = entry
      end do
      if (is_own) then
         call own_order(k*k, start, place(:entry), order, widest, info)
         call tally%check(widest <= 2*k, 'square: cuts are short')
      else
         info = metis_order(k*k, start, place(:entry), order)
      end if
      call tally%check(info == 0 .and. is_permutation(order), 'square: a permutation')
      call analyse(start, place(:entry), order, 1, factor, error)
      call tally%check(factor%entries < 1.3_wp*7.75_wp*k**2*log(real(k, wp))/log(2.0_wp), 'square: few entries')
   end subroutine a_square

   subroutine add(other, entry, place)
      integer, intent(in) :: other
      integer, intent(inout) :: entry, place(:)

      entry = entry + 1
      place(entry) = other
   end subroutine add

   !> In space, a cut has about the power 2/3 of the number of vertices: METIS is asked then.
   subroutine a_broad_cut(k)
      integer, intent(in) :: k
      integer, allocatable :: start(:), place(:)
      integer :: order(k**3), widest, info, i, j
      logical, allocatable :: is_joined(:, :)

      allocate (is_joined(k**3, k**3), source=.false.)
      do j = 0, k**3 - 1
         do i = j + 1, k**3 - 1
            is_joined(i + 1, j + 1) = abs(mod(i, k) - mod(j, k)) <= 1 .and. abs(mod(i/k, k) - mod(j/k, k)) <= 1 &
                                      .and. abs(i/k**2 - j/k**2) <= 1
         end do
      end do
      call lower(is_joined, start, place)
      call own_order(k**3, start, place, order, widest, info)
      call tally%check(info == 0 .and. widest >= k**2, 'cube: a broad cut')
   end subroutine a_broad_cut

   !> Two hubs, joined with each other and with all of a path, or with all that is not joined: few
   !> entries are left where the hubs are eliminated last.
   subroutine hubs(m, with_path)
      integer, intent(in) :: m
      logical, intent(in) :: with_path
      integer :: start(m + 3), place(4*m + 4), order(m + 2), widest, info, entry, j
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error

      start(1) = 0
      entry = 0
      do j = 1, m + 1
         call add(j, entry, place)
      end do
      start(2) = entry
      do j = 2, m + 1
         call add(j, entry, place)
      end do
      start(3) = entry
      do j = 2, m + 1
         if (with_path .and. j < m + 1) call add(j + 1, entry, place)
         start(j + 2) = entry
      end do
      call check_order('hubs', m + 2, start, place(:entry))
      call own_order(m + 2, start, place(:entry), order, widest, info)
      call analyse(start, place(:entry), order, 1, factor, error)
      call tally%check(factor%entries < 20*m, 'hubs: few entries')
   end subroutine hubs

   !> Many components once the hub is gone: quick, or the test does not end.
   subroutine a_star_of_arms(arms)
      integer, intent(in) :: arms
      integer :: start(arms + 2), i

      start(1) = 0
      start(2:) = arms
      call check_order('arms', arms + 1, start, [(i, i=1, arms)])
   end subroutine a_star_of_arms
end program test_nested_order
