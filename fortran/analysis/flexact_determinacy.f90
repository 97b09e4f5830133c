!> Kinematic and static determinacy, section 3 of the paper: the rank of D(c),
!> the motions that it leaves free and the self-stresses that it admits.
module flexact_determinacy
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_localise, only: localise
   use flexact_jacobian, only: jacobian_t, make_jacobian, fill_dense
   use flexact_scaling, only: scaling_t, make_scaling
   use flexact_rank, only: rank_t, decide_rank
   use flexact_decomposition, only: is_feasible, decompose, singular_values, orthonormalise, &
                                    status_fine, status_no_memory
   implicit none
   private
   public :: determinacy_t, analyse

   type :: determinacy_t
      !> status_fine, status_no_convergence or status_no_memory. Unless it is
      !> fine, nothing but the partition is to be used.
      integer :: status = status_fine
      !> Order of the rows and columns of D(c), and the counts.
      type(partition_t) :: partition
      !> Reference length of each element [m], (elements).
      real(wp), allocatable :: length(:)
      !> Singular values of D(c) as it stands, (min(rows, columns)), descending.
      real(wp), allocatable :: singular_values(:)
      !> Singular values of the scaled matrix, those above the tolerance make
      !> the rank.
      real(wp), allocatable :: scaled_values(:)
      type(rank_t) :: decision
      type(scaling_t) :: scaling
   end type determinacy_t

contains

   !> Analyse the reference configuration. The caller provides motions
   !> (columns, columns) and stresses (rows, rows), for the sizes that
   !> `count_model` tells; the first columns - rank columns of the one and
   !> rows - rank of the other come back as orthonormal bases of the null
   !> spaces of D(c) and of its transpose. The rest is work space.
   subroutine analyse(model, motions, stresses, result)
      type(model_t), intent(in) :: model
      real(wp), intent(inout), contiguous :: motions(:, :), stresses(:, :)
      type(determinacy_t), intent(out) :: result
      type(jacobian_t) :: jacobian
      real(wp), allocatable :: dense(:, :)
      integer :: rows, columns, values, info

      call make_partition(model, result%partition)
      rows = result%partition%count%rows
      columns = result%partition%count%columns
      result%status = status_no_memory
      if (.not. is_feasible(rows, columns)) return
      allocate (dense(rows, columns), stat=info)
      if (info /= 0) return
      values = min(rows, columns)
      allocate (result%singular_values(values), result%scaled_values(values), source=0.0_wp)

      call make_jacobian(model, model%node_value, jacobian)
      call make_scaling(model, result%partition, jacobian, result%scaling)
      call move_alloc(jacobian%length, result%length)
      call fill_dense(jacobian, result%partition, dense, result%scaling%row, result%scaling%column)
      call decompose(dense, result%scaled_values, stresses, motions, result%status)
      if (result%status /= status_fine) return
      call fill_dense(jacobian, result%partition, dense)
      call singular_values(dense, result%singular_values, result%status)
      if (result%status /= status_fine) return
      deallocate (dense)

      result%decision = decide_rank(result%scaling, result%scaled_values)
      call transpose_in_place(motions)
      call keep_null_space(motions, result%decision%rank, result%scaling%column, result%status)
      if (result%status /= status_fine) return
      call keep_null_space(stresses, result%decision%rank, result%scaling%row, result%status)
   end subroutine analyse

   !> Bring the columns beyond the rank to the front as an orthonormal basis of
   !> the null space of the matrix without its scales: D C v = 0 gives the
   !> motion C v, and likewise for a stress.
   pure subroutine keep_null_space(basis, rank, scale, status)
      real(wp), intent(inout), contiguous :: basis(:, :)
      integer, intent(in) :: rank
      real(wp), intent(in) :: scale(:)
      integer, intent(out) :: status
      integer :: j, found

      found = size(basis, 2) - rank
      do j = 1, found
         basis(:, j) = scale*basis(:, rank + j)
      end do
      call orthonormalise(basis(:, :found), status)
      if (status == status_fine) call localise(basis(:, :found), scale)
   end subroutine keep_null_space

   pure subroutine transpose_in_place(a)
      real(wp), intent(inout) :: a(:, :)
      real(wp) :: upper
      integer :: i, j

      do j = 2, size(a, 2)
         do i = 1, j - 1
            upper = a(i, j)
            a(i, j) = a(j, i)
            a(j, i) = upper
         end do
      end do
   end subroutine transpose_in_place
end module flexact_determinacy
