! SPDX-License-Identifier: BSD-3-Clause
!> The reduced echelon form of D(c), or of its transpose, modulo a prime: the residues of
!> null vectors, which some primes give as fractions.
module flexact_echelon
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_exact_matrix, only: exact_matrix_t, make_exact_matrix
   use flexact_exact_number, only: modular_arithmetic
   use flexact_modular, only: random_prime, modular_echelon
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_proof, only: all_typed, seed_of
   implicit none
   private
   public :: echelon_t, find_echelon

   type :: echelon_t
      integer(int64) :: prime = 0
      !> Of the decimals as typed, or of the doubles as stored.
      logical :: as_typed = .true.
      integer :: rank = 0
      !> The column of the first entry, which is one, of each of the first rows.
      integer, allocatable :: pivot(:)
      !> Residues, (columns, rows).
      integer(int64), allocatable :: entry(:, :)
   end type echelon_t

contains

   !> number: of the prime; each gives another. as_stored: numbers are no decimals.
   subroutine find_echelon(model, number, as_stored, is_transposed, echelon)
      type(model_t), intent(in) :: model
      integer, intent(in) :: number
      logical, intent(in) :: as_stored, is_transposed
      type(echelon_t), intent(out) :: echelon
      integer :: i

      allocate (echelon%pivot(0), echelon%entry(0, 0))
      echelon%prime = random_prime(ieor(seed_of(model), int(number, int64)))
      echelon%as_typed = all_typed(model) .and. .not. as_stored
      call make_dense(model, echelon)
      if (is_transposed) echelon%entry = transpose(echelon%entry)
      echelon%rank = modular_echelon(size(echelon%entry, 2), size(echelon%entry, 1), echelon%entry, echelon%prime)
      echelon%pivot = [(first_of(echelon%entry(:, i)), i=1, echelon%rank)]
   end subroutine find_echelon

   subroutine make_dense(model, echelon)
      type(model_t), intent(in) :: model
      type(echelon_t), intent(inout) :: echelon
      type(partition_t) :: partition
      type(exact_matrix_t) :: exact
      integer :: i, k

      call make_partition(model, partition)
      call make_exact_matrix(model, partition, [(i, i=1, partition%count%rows)], &
                             modular_arithmetic(echelon%prime, echelon%as_typed), exact)
      deallocate (echelon%entry)
      allocate (echelon%entry(partition%count%columns, partition%count%rows), source=0_int64)
      do i = 1, partition%count%rows
         do k = exact%start(i), exact%start(i + 1) - 1
            echelon%entry(exact%column(k), i) = exact%entry(k)%residue
         end do
      end do
   end subroutine make_dense

   pure integer function first_of(row)
      integer(int64), intent(in) :: row(:)

      do first_of = 1, size(row)
         if (row(first_of) /= 0) return
      end do
   end function first_of
end module flexact_echelon
