! SPDX-License-Identifier: BSD-3-Clause
!> From vectors of the null space of a matrix whose columns were scaled to those of
!> the matrix as it was: orthonormal within each connected component of the
!> vectors, and as local as they can be had.
module flexact_scaled_basis
   use flexact_components, only: components_t, find_components
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise
   use flexact_scaled_norm, only: length_of
   use flexact_sparse, only: operator_of
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   use flexact_varimax, only: varimax
   implicit none
   private
   public :: add_scaled, add_scaled_sparse, append_dense

   !> Entries times width up to which vectors are rotated: the cost of a sweep, some
   !> milliseconds.
   real(wp), parameter :: most_rotated = 1.0e5_wp
   !> Operations up to which sparse vectors are made orthonormal: about a second.
   real(wp), parameter :: most_orthonormal = 1.0e9_wp

contains

   !> Multiply vectors (n, k) by scale (n) and add them to a basis, orthonormal
   !> within each group that shares places. place (n): where their entries stand;
   !> ascending.
   subroutine add_scaled(vectors, place, scale, basis, error)
      real(wp), intent(in) :: vectors(:, :)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      type(sparse_basis_t) :: sparse
      type(components_t) :: groups
      integer :: i

      if (size(vectors, 2) == 0) return
      call new_sparse_basis(sparse)
      call append_dense(vectors, sparse)
      call find_components(operator_of(sparse%as_matrix(size(place))), groups)
      do i = 1, groups%count
         associate (used => groups%row(groups%row_start(i):groups%row_start(i + 1) - 1), &
                    members => groups%column(groups%column_start(i):groups%column_start(i + 1) - 1))
            if (size(members) == 0) exit
            call add_group(vectors(used, members), place(used), scale(used), basis, error)
         end associate
         if (allocated(error)) return
      end do
   end subroutine add_scaled

   !> Append the entries of vectors (n, k) that are not zero, with places from 1 on.
   pure subroutine append_dense(vectors, basis)
      real(wp), intent(in) :: vectors(:, :)
      type(sparse_basis_t), intent(inout) :: basis
      integer :: i, k

      do k = 1, size(vectors, 2)
         associate (there => abs(vectors(:, k)) > 0)
            call basis%add(pack([(i, i=1, size(vectors, 1))], there), pack(vectors(:, k), there))
         end associate
      end do
   end subroutine append_dense

   subroutine add_group(vectors, place, scale, basis, error)
      real(wp), intent(in) :: vectors(:, :)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: dense(size(vectors, 1), size(vectors, 2))
      integer :: j

      do j = 1, size(dense, 2)
         dense(:, j) = scale*vectors(:, j)
         dense(:, j) = dense(:, j)/length_of(dense(:, j))
      end do
      call orthonormalise(dense, error)
      if (allocated(error)) return
      if (real(size(dense), wp)*size(dense, 2) <= most_rotated) call varimax(dense, scale)
      do j = 1, size(dense, 2)
         call basis%add(pack(place, abs(dense(:, j)) > 0), pack(dense(:, j), abs(dense(:, j)) > 0))
      end do
   end subroutine add_group

   !> The same for sparse vectors, each with places from 1 on; orthonormal, unless
   !> that is too much work.
   subroutine add_scaled_sparse(vectors, place, scale, basis, error, is_orthonormal)
      type(sparse_basis_t), intent(in) :: vectors
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_orthonormal
      type(components_t) :: groups
      real(wp), allocatable :: dense(:, :)
      integer :: new_place(size(place)), i, j

      if (present(is_orthonormal)) is_orthonormal = .true.
      call find_components(operator_of(vectors%as_matrix(size(place))), groups)
      do i = 1, groups%count
         associate (used => groups%row(groups%row_start(i):groups%row_start(i + 1) - 1), &
                    members => groups%column(groups%column_start(i):groups%column_start(i + 1) - 1))
            if (size(members) == 0) exit
            if (size(members) > 1 .and. size(used)*real(size(members), wp)**2 <= most_orthonormal) then
               new_place(used) = [(j, j=1, size(used))]
               allocate (dense(size(used), size(members)), source=0.0_wp)
               do j = 1, size(members)
                  associate (from => vectors%start(members(j)), to => vectors%start(members(j) + 1) - 1)
                     dense(new_place(vectors%place(from:to)), j) = vectors%value(from:to)
                  end associate
               end do
               call add_group(dense, place(used), scale(used), basis, error)
               if (allocated(error)) return
               deallocate (dense)
            else
               if (present(is_orthonormal) .and. size(members) > 1) is_orthonormal = .false.
               do j = 1, size(members)
                  call add_single(vectors, members(j), place, scale, basis)
               end do
            end if
         end associate
      end do
   end subroutine add_scaled_sparse

   pure subroutine add_single(vectors, k, place, scale, basis)
      type(sparse_basis_t), intent(in) :: vectors
      integer, intent(in) :: k, place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      real(wp), allocatable :: value(:)

      associate (used => vectors%place(vectors%start(k):vectors%start(k + 1) - 1))
         allocate (value, source=vectors%value(vectors%start(k):vectors%start(k + 1) - 1)*scale(used))
         call basis%add(place(used), value/sign(length_of(value), value(maxloc(abs(value), 1))))
      end associate
   end subroutine add_single
end module flexact_scaled_basis
