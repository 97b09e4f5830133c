! SPDX-License-Identifier: BSD-3-Clause
!> Vectors side by side of which only the entries that are not zero are kept.
module flexact_sparse_basis
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: sparse_basis_t, new_sparse_basis

   type :: sparse_basis_t
      integer :: vectors = 0
      !> Entries start(k) to start(k + 1) - 1 belong to vector k.
      integer, allocatable :: start(:)
      integer, allocatable :: place(:)
      real(wp), allocatable :: value(:)
   contains
      procedure :: add
      procedure :: entries
      procedure :: deflate
      procedure :: as_matrix
   end type sparse_basis_t

contains

   pure subroutine new_sparse_basis(basis)
      type(sparse_basis_t), intent(out) :: basis

      allocate (basis%start(16), source=1)
      allocate (basis%place(64), basis%value(64))
   end subroutine new_sparse_basis

   pure integer function entries(basis)
      class(sparse_basis_t), intent(in) :: basis
      entries = basis%start(basis%vectors + 1) - 1
   end function entries

   !> Make vectors (n, k) orthogonal to the basis, which is orthonormal.
   pure subroutine deflate(basis, vectors)
      class(sparse_basis_t), intent(in) :: basis
      real(wp), intent(inout) :: vectors(:, :)
      integer :: j, k, first, last

      do k = 1, basis%vectors
         first = basis%start(k)
         last = basis%start(k + 1) - 1
         do j = 1, size(vectors, 2)
            associate (places => basis%place(first:last), values => basis%value(first:last))
               vectors(places, j) = vectors(places, j) - dot_product(values, vectors(places, j))*values
            end associate
         end do
      end do
   end subroutine deflate

   !> The vectors as the columns of a matrix with this many rows.
   pure function as_matrix(basis, rows) result(matrix)
      class(sparse_basis_t), intent(in) :: basis
      integer, intent(in) :: rows
      type(sparse_t) :: matrix

      matrix%rows = rows
      matrix%columns = basis%vectors
      allocate (matrix%start, source=basis%start(:basis%vectors + 1))
      allocate (matrix%place, source=basis%place(:basis%entries()))
      allocate (matrix%value, source=basis%value(:basis%entries()))
   end function as_matrix

   !> Append a vector; its places ascend.
   pure subroutine add(basis, place, value)
      class(sparse_basis_t), intent(inout) :: basis
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: value(:)
      integer :: first, last

      first = basis%entries() + 1
      last = basis%entries() + size(place)
      if (basis%vectors + 2 > size(basis%start)) call widen(basis%start, 2*size(basis%start))
      if (last > size(basis%place)) then
         call widen(basis%place, max(last, 2*size(basis%place)))
         call widen_reals(basis%value, size(basis%place))
      end if
      basis%place(first:last) = place
      basis%value(first:last) = value
      basis%vectors = basis%vectors + 1
      basis%start(basis%vectors + 1) = last + 1
   end subroutine add

   pure subroutine widen(list, length)
      integer, allocatable, intent(inout) :: list(:)
      integer, intent(in) :: length
      integer, allocatable :: longer(:)

      allocate (longer(length))
      longer(:size(list)) = list
      call move_alloc(longer, list)
   end subroutine widen

   pure subroutine widen_reals(list, length)
      real(wp), allocatable, intent(inout) :: list(:)
      integer, intent(in) :: length
      real(wp), allocatable :: longer(:)

      allocate (longer(length))
      longer(:size(list)) = list
      call move_alloc(longer, list)
   end subroutine widen_reals
end module flexact_sparse_basis
