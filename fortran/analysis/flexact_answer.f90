!> What is asked of an analysis, and what it answers.
module flexact_answer
   use flexact_kinds, only: wp
   use flexact_basis, only: basis_t
   use flexact_decomposition, only: method_svd, method_jacobi
   use flexact_rank, only: rank_t
   implicit none
   private
   public :: options_t, answer_t, most_pairs
   public :: method_auto, method_svd, method_jacobi, method_qr, method_sparse
   public :: status_no_library
   public :: stage_assembling, stage_ordering, stage_factorising, stage_motions, stage_stresses, stage_values

   !> Beside those of `flexact_decomposition`.
   integer, parameter :: method_auto = 0
   integer, parameter :: method_qr = 3
   integer, parameter :: method_sparse = 4

   !> Beside those of `flexact_decomposition`: SuiteSparse is asked for, and the
   !> build has none.
   integer, parameter :: status_no_library = 5

   !> So many of the smallest non-zero singular values come with their vectors.
   integer, parameter :: most_pairs = 6

   type :: options_t
      integer :: method = method_auto
      !> Scaled singular values up to here count as zero; from the data without.
      real(wp), allocatable :: tolerance
      !> Bytes of memory that may be used.
      real(wp) :: memory = huge(1.0_wp)
      !> Whether, in place of all else, the smallest singular values of D(c) itself
      !> are wanted, which come as scaled values then.
      logical :: only_plain_values = .false.
      !> Where a caller watches: what is at work (see below) and per cent of it.
      integer, pointer :: stage(:) => null()
   contains
      procedure :: tell
   end type options_t

   integer, parameter :: stage_assembling = 0
   integer, parameter :: stage_ordering = 1
   integer, parameter :: stage_factorising = 2
   integer, parameter :: stage_motions = 3
   integer, parameter :: stage_stresses = 4
   integer, parameter :: stage_values = 5

   type :: answer_t
      !> Unless it is status_fine, nothing else is to be used but `bytes`.
      integer :: status = 0
      !> Bytes of memory that would be needed, where it did not suffice.
      real(wp) :: bytes = 0.0_wp
      !> What was used; never method_auto.
      integer :: method = method_svd
      !> Whether error bounds, or two independent routes, support the rank.
      logical :: confirmed = .true.
      type(rank_t) :: decision
      !> Singular values of D(c) itself and of the scaled matrix, descending: all
      !> of them, or the smallest. Without the first, (0).
      real(wp), allocatable :: singular_values(:), scaled_values(:)
      !> The smallest non-zero scaled values, ascending, (p), with their right
      !> and left singular vectors, (columns, p) and (rows, p).
      real(wp), allocatable :: pair_value(:), pair_motion(:, :), pair_stress(:, :)
      !> Bases of the null spaces of D(c) and its transpose, orthonormal as far as
      !> `flexact_modes` says.
      type(basis_t) :: motions, stresses
   end type answer_t

contains

   !> Let the caller know what is at work, the first `done` of `total` of which is
   !> done.
   subroutine tell(options, stage, done, total)
      class(options_t), intent(in) :: options
      integer, intent(in) :: stage, done, total

      if (associated(options%stage)) options%stage = [stage, int(100*(real(done, wp)/max(total, 1)))]
   end subroutine tell
end module flexact_answer
