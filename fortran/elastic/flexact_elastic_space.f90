! SPDX-License-Identifier: BSD-3-Clause
!> The motions that rigid rows leave, and least-norm answers to the rows.
module flexact_elastic_space
   use flexact_elastic_layout, only: layout_t, make_layout, free_part, whole_vector
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_rows, only: rows_t
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_projection_pattern, only: projection_t, prepare
   use flexact_row_space, only: row_space_t, analyse_rows, find_multipliers, follow_rows
   use flexact_sparse, only: sparse_t, compress, times, times_transposed
   implicit none
   private
   public :: space_t, make_space, reduced, reduced_sizes, expanded, answer, multipliers_of

   !> Norms are those of lengths and forces: rotations are taken times a length, and moments over
   !> it. motions: columns of the basis Z.
   type :: space_t
      integer :: motions = 0
      type(layout_t) :: layout
      type(projection_t) :: projection
      type(row_space_t) :: rows
      !> Of each row: 1, or a length where it is about an angle.
      real(wp), allocatable :: weight(:)
      logical :: failed = .false.
   end type space_t

   !> Rows of which no more is left than this, of 1, depend on others.
   real(wp), parameter :: tolerance = 1.0e-9_wp

contains

   subroutine make_space(elastic, rows, space)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      type(space_t), intent(inout) :: space
      type(sparse_t) :: matrix
      type(error_t), allocatable :: error

      if (.not. allocated(space%layout%column)) call make_layout(elastic, space%layout)
      space%weight = row_weights(elastic, rows)
      call make_matrix(elastic, rows, space, matrix)
      call analyse_rows(matrix, space%rows, error, tolerance)
      space%failed = allocated(error)
      if (space%failed) return
      space%motions = space%rows%basis%columns
      call prepare(space%rows%basis, space%layout%matrix, space%projection)
   end subroutine make_space

   subroutine make_matrix(elastic, rows, space, matrix)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      type(space_t), intent(in) :: space
      type(sparse_t), intent(out) :: matrix
      integer :: row(size(rows%entry)), column(size(rows%entry)), r, i, entries
      real(wp) :: value(size(rows%entry))

      entries = 0
      do r = 1, rows%count
         do i = 1, size(rows%entry, 1)
            associate (e => rows%entry(i, r))
               if (e == 0 .or. .not. abs(rows%value(i, r)) > 0) cycle
               entries = entries + 1
               row(entries) = r
               column(entries) = space%layout%column(e)
               value(entries) = space%weight(r)*rows%value(i, r)/elastic%scale(e)
            end associate
         end do
      end do
      call compress(rows%count, space%layout%columns, row(:entries), column(:entries), value(:entries), matrix)
   end subroutine make_matrix

   !> Rows of angles are multiplied by the length.
   pure function row_weights(elastic, rows) result(weight)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      real(wp) :: weight(rows%count)
      integer :: r, i

      weight = elastic%length
      do r = 1, rows%count
         do i = 1, size(rows%entry, 1)
            if (rows%entry(i, r) == 0) cycle
            if (abs(rows%value(i, r)) > 0 .and. .not. elastic%is_turn(rows%entry(i, r))) weight(r) = 1.0_wp
         end do
      end do
   end function row_weights

   !> Z' f.
   function reduced(space, elastic, f) result(y)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: f(:)
      real(wp) :: y(space%motions), made(space%motions, 1)

      call times_transposed(space%projection%basis, &
                            reshape(free_part(elastic, space%layout, f), [space%layout%columns, 1]), made)
      y = made(:, 1)
   end function reduced

   !> |Z|' f.
   pure function reduced_sizes(space, elastic, f) result(y)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: f(:)
      real(wp) :: y(space%motions), columns(space%layout%columns)
      integer :: j

      columns = free_part(elastic, space%layout, f)
      associate (z => space%projection%basis)
         do j = 1, space%motions
            y(j) = dot_product(abs(z%value(z%start(j):z%start(j + 1) - 1)), columns(z%place(z%start(j):z%start(j + 1) - 1)))
         end do
      end associate
   end function reduced_sizes

   !> Z y.
   function expanded(space, elastic, y) result(v)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: y(:)
      real(wp) :: v(size(elastic%scale)), made(space%layout%columns, 1)

      call times(space%projection%basis, reshape(y, [space%motions, 1]), made)
      v = whole_vector(elastic, space%layout, made(:, 1))
   end function expanded

   !> The least motion v of free entries with J v = c, as far as there is one. mismatch: the part
   !> of c that contradicts itself.
   subroutine answer(space, elastic, c, v, mismatch)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: c(:)
      real(wp), intent(out) :: v(:), mismatch
      real(wp) :: made(space%layout%columns, 1), wrong(1)

      call follow_rows(space%rows, reshape(c*space%weight, [size(c), 1]), made, wrong)
      v = whole_vector(elastic, space%layout, made(:, 1))
      mismatch = wrong(1)
   end subroutine answer

   !> The least multipliers m with J'm = f on free entries, as far as there are any.
   function multipliers_of(space, elastic, f) result(m)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: f(:)
      real(wp) :: m(size(space%weight)), made(size(space%weight), 1)

      call find_multipliers(space%rows, reshape(free_part(elastic, space%layout, f), [space%layout%columns, 1]), made)
      m = made(:, 1)*space%weight
   end function multipliers_of
end module flexact_elastic_space
