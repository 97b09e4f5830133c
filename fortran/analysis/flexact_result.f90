! SPDX-License-Identifier: BSD-3-Clause
!> What is asked of an analysis, and what it answers.
module flexact_result
   use flexact_decomposition, only: method_svd, method_jacobi
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_progress, only: progress_t
   use flexact_proof, only: proof_t, prove_by_cost
   use flexact_rank, only: rank_t
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: options_t, result_t, most_pairs
   public :: method_auto, method_svd, method_jacobi, method_sparse, method_names

   !> Beside those of `flexact_decomposition`.
   integer, parameter :: method_auto = 0
   integer, parameter :: method_sparse = 3
   character(len=24), parameter :: method_names(0:3) = [character(len=24) :: 'auto', 'svd', 'jacobi', 'sparse']

   !> The smallest non-zero singular values come with their vectors, up to this
   !> number: a body has six coordinates.
   integer, parameter :: most_pairs = 6

   type :: options_t
      integer :: method = method_auto
      !> Scaled singular values up to here count as zero; from the data without.
      real(wp), allocatable :: tolerance
      !> Bytes of memory that may be used.
      real(wp) :: memory = huge(1.0_wp)
      !> Whether, in place of all else, the singular values of D(c) itself are wanted
      !> (by sparse the smallest), which come as scaled values then.
      logical :: only_plain_values = .false.
      !> Whether the rank is to be proven in exact arithmetic.
      integer :: prove = prove_by_cost
      !> Whether numbers are what is stored, though they may look like decimals.
      logical :: as_stored = .false.
      type(progress_t) :: progress
   end type options_t

   type :: result_t
      !> Where it is allocated, nothing else is to be used but `bytes`.
      type(error_t), allocatable :: error
      !> Bytes of memory that would be needed, where it did not suffice.
      real(wp) :: bytes = 0.0_wp
      !> What was used; never method_auto.
      integer :: method = method_svd
      !> Whether error bounds, or two independent routes, support the rank.
      logical :: confirmed = .true.
      !> Below this no more scaled values lie than were pinned: by sparse what its
      !> factorisation shows, the least of all components; else the noise.
      real(wp) :: bound = 0.0_wp
      type(proof_t) :: proof
      !> So many values that count as zero may not be, by exact arithmetic or more digits; and
      !> so many do not count as zero by exact arithmetic alone.
      integer :: undecided = 0, unseen = 0
      !> So many of those undecided are only because their vectors fade.
      integer :: fading = 0
      !> The largest of them, and what storing the geometry makes of it; zeros where that
      !> is not known.
      real(wp) :: left = 0.0_wp, explained = 0.0_wp
      !> Whether there are zeros that nothing but the decomposition has seen.
      logical :: unjudged = .false.
      type(rank_t) :: decision
      !> Singular values of the scaled matrix, descending: all of them, or the smallest.
      real(wp), allocatable :: scaled_values(:)
      !> The smallest non-zero scaled values, ascending, (p), with their right
      !> and left singular vectors, (columns, p) and (rows, p).
      real(wp), allocatable :: pair_value(:), pair_motion(:, :), pair_stress(:, :)
      !> Bases of the null spaces of D(c) and its transpose, orthonormal as far as
      !> `flexact_scaled_basis` says.
      type(sparse_basis_t) :: motions, stresses
   end type result_t
end module flexact_result
