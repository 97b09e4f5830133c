!> From null spaces to motions and self-stresses: vectors of D(c) itself, as
!> local as they can be had, orthonormal.
module flexact_modes
   use flexact_kinds, only: wp
   use flexact_basis, only: basis_t
   use flexact_decomposition, only: orthonormalise, status_fine
   use flexact_localise, only: localise
   use flexact_vectors, only: length_of
   implicit none
   private
   public :: untangle, add_modes, add_sparse_modes

   !> Entries below this part of the largest one of a vector are rounding.
   real(wp), parameter :: nothing = 1.0e-11_wp
   !> Larger groups are not turned: the cost grows with the square of the width.
   real(wp), parameter :: most_work = 1.0e5_wp
   !> So many operations are spent on making sparse vectors orthonormal.
   real(wp), parameter :: most_orthogonal = 1.0e9_wp

contains

   !> Combine vectors (n, k) so that each has an entry, its largest, where the
   !> others have none: those of mechanisms that do not touch come apart. entry
   !> (k): the places of these, 0 for what is left where vectors depend on others.
   pure subroutine untangle(vectors, entry)
      real(wp), intent(inout) :: vectors(:, :)
      integer, intent(out), optional :: entry(:)
      real(wp) :: weight(size(vectors, 1))
      integer :: place(2), step, j

      if (present(entry)) entry = 0
      do step = 1, size(vectors, 2)
         place = maxloc(abs(vectors(:, step:)))
         j = step + place(2) - 1
         if (.not. abs(vectors(place(1), j)) > 0) return
         if (present(entry)) entry(step) = place(1)
         weight = vectors(:, j)/vectors(place(1), j)
         vectors(:, j) = vectors(:, step)
         vectors(:, step) = weight
         do j = 1, size(vectors, 2)
            if (j /= step) vectors(:, j) = vectors(:, j) - vectors(place(1), j)*weight
         end do
      end do
      do j = 1, size(vectors, 2)
         where (abs(vectors(:, j)) <= nothing*maxval(abs(vectors(:, j)))) vectors(:, j) = 0.0_wp
      end do
   end subroutine untangle

   !> Scale vectors (n, k) of a part, so that they are those of D(c) itself, and add
   !> them to a basis, orthonormal within each group that shares places. place (n):
   !> where the part's entries stand; ascending.
   subroutine add_modes(vectors, place, scale, basis, status)
      real(wp), intent(inout) :: vectors(:, :)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(basis_t), intent(inout) :: basis
      integer, intent(out) :: status
      integer :: group(size(vectors, 2)), i, j, k
      integer, allocatable :: members(:), used(:)
      real(wp), allocatable :: dense(:, :)

      status = status_fine
      call find_groups(vectors, group)
      do k = 1, size(vectors, 2)
         if (group(k) /= k) cycle
         members = pack([(j, j=1, size(group))], group == k)
         used = pack([(i, i=1, size(place))], [(any(abs(vectors(i, members)) > 0), i=1, size(place))])
         dense = vectors(used, members)
         do j = 1, size(members)
            dense(:, j) = scale(used)*dense(:, j)
            dense(:, j) = dense(:, j)/length_of(dense(:, j))
         end do
         call orthonormalise(dense, status)
         if (status /= status_fine) return
         if (real(size(dense), wp)*size(members) <= most_work) call localise(dense, scale(used))
         do j = 1, size(members)
            call add_vector(place(used), dense(:, j), basis)
         end do
      end do
   end subroutine add_modes

   !> The same for sparse vectors of a part, each with places from 1 on.
   subroutine add_sparse_modes(vectors, place, scale, basis, status, is_orthonormal)
      type(basis_t), intent(in) :: vectors
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(basis_t), intent(inout) :: basis
      integer, intent(out) :: status
      logical, intent(out), optional :: is_orthonormal
      logical :: is_group_orthonormal
      integer :: group(vectors%vectors), owner(size(place)), first(vectors%vectors), next(vectors%vectors), k

      status = status_fine
      if (present(is_orthonormal)) is_orthonormal = .true.
      call group_sparse(vectors, owner, group)
      first = 0
      do k = vectors%vectors, 1, -1
         next(k) = first(group(k))
         first(group(k)) = k
      end do
      do k = 1, vectors%vectors
         if (first(k) == 0) cycle
         call add_group(vectors, members_from(first(k), next), place, scale, basis, is_group_orthonormal, status)
         if (present(is_orthonormal)) is_orthonormal = is_orthonormal .and. is_group_orthonormal
         if (status /= status_fine) return
      end do
   end subroutine add_sparse_modes

   pure function members_from(first, next) result(members)
      integer, intent(in) :: first, next(:)
      integer, allocatable :: members(:)
      integer :: k, count

      count = 0
      k = first
      do while (k /= 0)
         count = count + 1
         k = next(k)
      end do
      allocate (members(count))
      count = 0
      k = first
      do while (k /= 0)
         count = count + 1
         members(count) = k
         k = next(k)
      end do
   end function members_from

   !> Add sparse vectors that share places: orthonormal, unless that is too much work.
   subroutine add_group(vectors, members, place, scale, basis, is_orthonormal, status)
      type(basis_t), intent(in) :: vectors
      integer, intent(in) :: members(:), place(:)
      real(wp), intent(in) :: scale(:)
      type(basis_t), intent(inout) :: basis
      logical, intent(out) :: is_orthonormal
      integer, intent(out) :: status
      real(wp), allocatable :: dense(:, :)
      integer, allocatable :: used(:)
      logical :: is_used(size(place))
      integer :: new_place(size(place)), i, j

      status = status_fine
      is_orthonormal = .true.
      if (size(members) == 1) then
         call add_single(vectors, members(1), place, scale, basis)
         return
      end if
      is_used = .false.
      do j = 1, size(members)
         is_used(vectors%place(vectors%start(members(j)):vectors%start(members(j) + 1) - 1)) = .true.
      end do
      used = pack([(i, i=1, size(place))], is_used)
      if (real(size(used), wp)*size(members)**2 > most_orthogonal) then
         is_orthonormal = .false.
         do j = 1, size(members)
            call add_single(vectors, members(j), place, scale, basis)
         end do
         return
      end if
      new_place(used) = [(i, i=1, size(used))]
      allocate (dense(size(used), size(members)), source=0.0_wp)
      do j = 1, size(members)
         associate (from => vectors%start(members(j)), to => vectors%start(members(j) + 1) - 1)
            dense(new_place(vectors%place(from:to)), j) = vectors%value(from:to)
         end associate
      end do
      call add_modes(dense, place(used), scale(used), basis, status)
   end subroutine add_group

   pure subroutine add_single(vectors, k, place, scale, basis)
      type(basis_t), intent(in) :: vectors
      integer, intent(in) :: k, place(:)
      real(wp), intent(in) :: scale(:)
      type(basis_t), intent(inout) :: basis
      real(wp), allocatable :: value(:)

      associate (used => vectors%place(vectors%start(k):vectors%start(k + 1) - 1))
         value = vectors%value(vectors%start(k):vectors%start(k + 1) - 1)*scale(used)
         call basis%add(place(used), value/sign(length_of(value), value(maxloc(abs(value), 1))))
      end associate
   end subroutine add_single

   !> Group sparse vectors that share places, directly or through others: each gets
   !> the number of the first of its group.
   pure subroutine group_sparse(vectors, owner, group)
      type(basis_t), intent(in) :: vectors
      integer, intent(out) :: owner(:), group(:)
      integer :: k, entry, a, b

      owner = 0
      group = [(k, k=1, size(group))]
      do k = 1, vectors%vectors
         do entry = vectors%start(k), vectors%start(k + 1) - 1
            associate (holder => owner(vectors%place(entry)))
               if (holder == 0) then
                  holder = k
               else
                  a = root(holder)
                  b = root(k)
                  group(max(a, b)) = min(a, b)
               end if
            end associate
         end do
      end do
      do k = 1, size(group)
         group(k) = root(k)
      end do
   contains
      pure integer function root(k)
         integer, intent(in) :: k
         root = k
         do while (group(root) /= root)
            root = group(root)
         end do
      end function root
   end subroutine group_sparse

   pure subroutine add_vector(place, values, basis)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: values(:)
      type(basis_t), intent(inout) :: basis
      logical :: there(size(values))

      there = abs(values) > 0
      call basis%add(pack(place, there), pack(values, there))
   end subroutine add_vector

   !> Vectors that share a place, directly or through others, get one number: that
   !> of the first of them.
   pure subroutine find_groups(vectors, group)
      real(wp), intent(in) :: vectors(:, :)
      integer, intent(out) :: group(:)
      integer :: owner, i, k

      group = [(k, k=1, size(group))]
      do i = 1, size(vectors, 1)
         owner = 0
         do k = 1, size(group)
            if (.not. abs(vectors(i, k)) > 0) cycle
            if (owner == 0) then
               owner = group(k)
            else if (group(k) /= owner) then
               where (group == max(owner, group(k))) group = min(owner, group(k))
               owner = group(k)
            end if
         end do
      end do
   end subroutine find_groups
end module flexact_modes
