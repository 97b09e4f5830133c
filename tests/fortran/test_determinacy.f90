! SPDX-License-Identifier: BSD-3-Clause
!> Rank, motions and self-stresses of mechanisms with known answers.
program test_determinacy
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_slots, only: node_position
   use flexact_partition, only: partition_t, make_partition
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_element_table, only: find_element_kind
   use flexact_determinacy, only: analyse
   use flexact_problem, only: problem_t
   use flexact_result, only: result_t, options_t, method_svd, method_jacobi, method_sparse
   use flexact_sparse_basis, only: sparse_basis_t
   use flexact_testing, only: tally_t
   use flexact_test_models, only: new_model, set_node, set_element, fix, twelve_trusses, folded_sheet, &
                                  parallel_guide, fill_dense
   implicit none

   type(tally_t) :: tally
   real(wp), parameter :: lengths(5) = [1.0e-9_wp, 1.0e-3_wp, 1.0_wp, 1.0e3_wp, 1.0e6_wp]
   real(wp), allocatable :: motions(:, :), stresses(:, :)
   integer, parameter :: methods(3) = [method_svd, method_jacobi, method_sparse]
   type(result_t) :: answer
   type(problem_t) :: problem

   call test_twelve_trusses()
   call test_far_from_origin()
   call test_collinear_bars()
   call test_folded_sheet()
   call test_parallel_guide()
   call test_empty_shapes()
   call test_long_joint()
   call test_noise_of_zeros()
   call tally%finish()

contains

   !> Every method gives the counts and bases of both null spaces; what svd
   !> gives is left for further checks.
   subroutine run(model, name, free, stressed)
      type(model_t), intent(in) :: model
      character(len=*), intent(in) :: name
      integer, intent(in) :: free, stressed
      type(options_t) :: options
      integer :: i

      do i = size(methods), 1, -1
         options%method = methods(i)
         call analyse(model, options, problem, answer)
         call tally%check(.not. allocated(answer%error), name//': status')
         call tally%check(answer%confirmed, name//': confirmed')
         call tally%check(problem%matrix%by_column%columns - answer%decision%rank == free, name//': motions')
         call tally%check(problem%matrix%by_column%rows - answer%decision%rank == stressed, name//': self-stresses')
         motions = dense(answer%motions, problem%matrix%by_column%columns)
         stresses = dense(answer%stresses, problem%matrix%by_column%rows)
         call check_null_spaces(model, name, free, stressed)
      end do
   end subroutine run

   pure function dense(basis, length) result(vectors)
      type(sparse_basis_t), intent(in) :: basis
      integer, intent(in) :: length
      real(wp) :: vectors(length, basis%vectors)
      integer :: k

      vectors = 0.0_wp
      do k = 1, basis%vectors
         vectors(basis%place(basis%start(k):basis%start(k + 1) - 1), k) = &
            basis%value(basis%start(k):basis%start(k + 1) - 1)
      end do
   end function dense

   !> D V = 0 and U' D = 0 to rounding, entry by entry against the sizes of
   !> what is added up, and orthonormal bases.
   subroutine check_null_spaces(model, name, free, stressed)
      type(model_t), intent(in) :: model
      character(len=*), intent(in) :: name
      integer, intent(in) :: free, stressed
      type(partition_t) :: partition
      type(jacobian_t) :: jacobian
      real(wp) :: d(size(stresses, 1), size(motions, 1))

      call tally%check(size(motions, 2) == free, name//': vectors of motions')
      call tally%check(size(stresses, 2) == stressed, name//': vectors of self-stresses')
      call make_partition(model, partition)
      call make_jacobian(model, model%node_value, jacobian)
      call fill_dense(jacobian, partition, d)
      associate (v => motions, u => stresses)
         call tally%check(all(abs(matmul(d, v)) <= 1.0e-13_wp*maxval(abs(d))), name//': motion residual')
         call tally%check(all(abs(matmul(transpose(d), u)) <= 1.0e-13_wp*maxval(abs(d))), name//': stress residual')
         call check_orthonormal(v, name)
         call check_orthonormal(u, name)
      end associate
   end subroutine check_null_spaces

   subroutine check_orthonormal(basis, name)
      real(wp), intent(in) :: basis(:, :)
      character(len=*), intent(in) :: name
      real(wp) :: gram(size(basis, 2), size(basis, 2))
      integer :: i

      gram = matmul(transpose(basis), basis)
      do i = 1, size(gram, 1)
         gram(i, i) = gram(i, i) - 1
      end do
      call tally%check(all(abs(gram) < 1.0e-14_wp), name//': orthonormal')
   end subroutine check_orthonormal

   !> A joint on bars to fixed places (3, bars).
   function joint_on(place) result(model)
      real(wp), intent(in) :: place(:, :)
      type(model_t) :: model
      integer :: k

      model = new_model(size(place, 2) + 1, size(place, 2))
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      do k = 1, size(place, 2)
         call set_node(model, k + 1, node_position, place(:, k))
         call fix(model, [k + 1])
         call set_element(model, k, find_element_kind('TRUSS'), [1, 0, k + 1, 0])
      end do
   end function joint_on

   !> Each bar after the third is one too many. No square of their number is made:
   !> memory that would not hold one suffices.
   subroutine test_long_joint()
      integer, parameter :: bars = 5000
      real(wp) :: place(3, bars), left(3)
      type(options_t) :: options
      integer :: i, k, entry

      call random_number(place)
      options%memory = 5.0e6_wp
      do i = 1, 2
         options%method = methods(i)
         call analyse(joint_on(place), options, problem, answer)
         call tally%check(.not. allocated(answer%error), 'long joint: status')
         if (allocated(answer%error)) cycle
         call tally%check(answer%decision%rank == 3 .and. answer%motions%vectors == 0, 'long joint: rank')
         call tally%check(answer%stresses%vectors == bars - 3, 'long joint: all self-stresses')
         call tally%check(answer%stresses%entries() <= 4*bars, 'long joint: of four bars each')
         do k = 1, answer%stresses%vectors
            left = 0.0_wp
            do entry = answer%stresses%start(k), answer%stresses%start(k + 1) - 1
               associate (p => place(:, answer%stresses%place(entry)))
                  left = left + answer%stresses%value(entry)*p/norm2(p)
               end associate
            end do
            if (any(abs(left) > 1.0e-13_wp)) exit
         end do
         call tally%check(k > answer%stresses%vectors, 'long joint: in equilibrium')
      end do
   end subroutine test_long_joint

   !> Bars along x, y and z: D(c) is diagonal, its errors are not. They are as
   !> large as those of bars at right angles that are turned.
   subroutine test_noise_of_zeros()
      real(wp), parameter :: straight(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      real(wp), parameter :: turned(3, 3) = reshape([2, 2, 1, -2, 1, 2, 1, -2, 2], [3, 3])/3.0_wp
      type(problem_t) :: other

      call analyse(joint_on(straight), options_t(), problem, answer)
      call analyse(joint_on(turned), options_t(), other, answer)
      associate (bits => problem%scaling%error_of_bits, less => other%scaling%error_of_bits)
         call tally%check(bits >= less .and. bits < 2*less, 'noise of zeros')
      end associate
   end subroutine test_noise_of_zeros

   !> Table 2 and the text of the paper; singular values of D(c) recomputed
   !> by hand from the symmetry of the ring.
   subroutine test_twelve_trusses()
      real(wp), parameter :: golden = (1 + sqrt(5.0_wp))/2
      real(wp), parameter :: table2(12) = [0.0_wp, -0.5_wp, 0.0_wp, -0.5_wp, 0.0_wp, 0.0_wp, &
                                           0.0_wp, 0.5_wp, 0.0_wp, 0.5_wp, 0.0_wp, 0.0_wp]
      real(wp), parameter :: values(12) = [sqrt(3.0_wp), golden, golden, sqrt(2.0_wp), 1.0_wp, 1.0_wp, &
                                           1.0_wp, 1.0_wp, 1.0_wp, golden - 1, golden - 1, 0.0_wp]

      type(result_t) :: plain
      type(problem_t) :: unscaled

      call run(twelve_trusses(), 'twelve trusses', 1, 1)
      call analyse(twelve_trusses(), options_t(only_plain_values=.true.), unscaled, plain)
      call tally%near(plain%scaled_values, values, 1.0e-14_wp, 'their singular values')
      call tally%near(abs(dot_product(table2, motions(:, 1)))*[1.0_wp], [1.0_wp], 1.0e-15_wp, 'motion of Table 2')
      call tally%near(abs(stresses(:, 1)), spread(sqrt(3.0_wp)/6, 1, 12), 1.0e-14_wp, 'stress')
      call tally%check(count(stresses(:, 1) > 0) == 6, 'half of the stresses are negative')
      call tally%near([problem%scaling%characteristic_length], [sqrt(2.0_wp)], 1.0e-15_wp, 'length')
   end subroutine test_twelve_trusses

   !> The verdict stays although the coordinates are rounded more and more.
   subroutine test_far_from_origin()
      type(model_t) :: model
      integer :: power
      character(len=32) :: name

      do power = 0, 12
         model = twelve_trusses()
         model%node_value(1:3, :) = model%node_value(1:3, :)/3 + 10.0_wp**power*sqrt(2.0_wp)
         write (name, '(a, i0, a)') 'trusses 10^', power, ' from the origin'
         call run(model, trim(name), 1, 1)
      end do
   end subroutine test_far_from_origin

   subroutine test_collinear_bars()
      type(model_t) :: model
      integer :: i

      model = new_model(3, 2)
      do i = 1, 3
         call set_node(model, i, node_position, [0.1_wp, 0.2_wp, 0.3_wp]*(i - 2))
      end do
      call fix(model, [1, 3])
      call set_element(model, 1, find_element_kind('TRUSS'), [1, 0, 2, 0])
      call set_element(model, 2, find_element_kind('TRUSS'), [2, 0, 3, 0])
      call run(model, 'collinear bars in space', 2, 1)
   end subroutine test_collinear_bars

   !> The stress is two equal and opposite in-plane moments at the clamped
   !> ends, e3 of the first sheet and e4 of the second; verdict and scaled
   !> values are the same in every unit of length.
   subroutine test_folded_sheet()
      real(wp), parameter :: expected(6) = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]/sqrt(2.0_wp)
      real(wp), allocatable :: scaled(:)
      integer :: i

      call run(folded_sheet(1.0_wp), 'folded sheet', 1, 1)
      scaled = answer%scaled_values
      do i = 1, size(lengths)
         call run(folded_sheet(lengths(i)), 'folded sheet of any size', 1, 1)
         call tally%near(answer%scaled_values, scaled, 1.0e-14_wp, 'scaled values of any size')
         call tally%near(abs(stresses(:, 1)), expected, 1.0e-14_wp, 'moments at the clamped ends')
      end do
   end subroutine test_folded_sheet

   !> One motion, the translation along y, and a constant in-plane moment in
   !> both sheets. Rotations are compared after multiplication by a length.
   subroutine test_parallel_guide()
      real(wp), parameter :: along_y(9) = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: motion(9)
      integer :: i

      do i = 1, size(lengths)
         call run(parallel_guide(lengths(i)), 'parallel guide', 1, 1)
         motion = motions(:, 1)/problem%scaling%column
         call tally%near(abs(motion)/norm2(motion), along_y/sqrt(2.0_wp), 1.0e-14_wp, 'it moves along y')
         call tally%near(abs(stresses([2, 3, 5, 6], 1)), [0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp], 1.0e-14_wp, &
                         'constant in-plane moments')
      end do
   end subroutine test_parallel_guide

   subroutine test_empty_shapes()
      type(model_t) :: model

      model = new_model(0, 0)
      call run(model, 'nothing', 0, 0)
      model = folded_sheet(1.0_wp)
      call fix(model, [3, 4])
      call run(model, 'no columns', 0, 6)
      model = twelve_trusses()
      model%deformation_class = merge(2, 0, model%deformation_class > 0)
      call run(model, 'no rows', 12, 0)
   end subroutine test_empty_shapes
end program test_determinacy
