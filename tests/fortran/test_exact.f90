! SPDX-License-Identifier: BSD-3-Clause
!> D(c) in exact arithmetic: its numbers, its rows beside those of the Jacobian, and proofs
!> of ranks that follow from geometry.
program test_exact
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_element_table, only: element_kinds, find_element_kind, vector_none, vector_required
   use flexact_exact_matrix, only: exact_matrix_t, make_exact_matrix
   use flexact_exact_number, only: arithmetic_t, number_t, modular_arithmetic, many_digits, number_of, whole, &
                                   operator(+), operator(-), operator(*)
   use flexact_echelon, only: echelon_t, find_echelon
   use flexact_modular, only: random_prime, dense_modular_rank, modular_product
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_kinds, only: wp, qp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_problem, only: problem_t, make_problem
   use flexact_proof, only: proof_t, prove, prove_always, prove_never, unknown
   use flexact_rounding, only: typed_t, typed
   use flexact_slots, only: node_position, node_planar_position, node_orientation
   use flexact_test_models, only: new_model, set_node, set_element, fix, twelve_trusses, fill_dense
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally
   !> The Mersenne prime 2**61 - 1; residues modulo it were computed with integers of Python.
   integer(int64), parameter :: mersenne = 2_int64**61 - 1
   real(wp), parameter :: memory = 1.0e9_wp

   call decimals_as_typed()
   call numbers_of_many_digits()
   call rows_of_every_kind()
   call nothing_is_proven_unasked()
   call numbers_modulo_a_prime()
   call doubles_modulo_a_prime()
   call primes()
   call ranks_modulo_a_prime()
   call proof_of_twelve_trusses()
   call collinear_decimals()
   call collinear_doubles()
   call echelon_of_collinear_decimals()
   call tally%finish()

contains

   !> Whether mantissa * 10**place is what was typed; trailing zeros do not matter.
   logical function is(value, mantissa, place)
      real(wp), intent(in) :: value
      integer(int64), intent(in) :: mantissa
      integer, intent(in) :: place
      type(typed_t) :: found

      found = typed(value)
      do while (found%place < place .and. mod(found%mantissa, 10_int64) == 0)
         found%mantissa = found%mantissa/10
         found%place = found%place + 1
      end do
      is = found%short .and. found%mantissa == mantissa .and. (found%place == place .or. mantissa == 0)
   end function is

   subroutine decimals_as_typed()
      type(typed_t) :: root, third

      call tally%check(is(0.1_wp, 1_int64, -1), 'a tenth')
      call tally%check(is(1.0e-10_wp, 1_int64, -10), '1e-10')
      call tally%check(is(123456789012345.0_wp, 123456789012345_int64, 0), 'fifteen digits')
      call tally%check(is(1.23456789012345e-30_wp, 123456789012345_int64, -44), 'fifteen digits of a small number')
      call tally%check(is(1.23456789012345e30_wp, 123456789012345_int64, 16), 'of a large number')
      call tally%check(is(-0.00039_wp, -39_int64, -5), 'a negative decimal')
      call tally%check(is(0.0_wp, 0_int64, 0), 'zero')
      root = typed(sqrt(2.0_wp))
      third = typed(1.0_wp/3)
      call tally%check(.not. (root%short .or. third%short), 'no fifteen digits give it')
   end subroutine decimals_as_typed

   subroutine numbers_of_many_digits()
      type(arithmetic_t) :: arithmetic
      type(number_t) :: sum

      arithmetic = many_digits(.true.)
      sum = number_of(0.1_wp, arithmetic) + number_of(0.2_wp, arithmetic) - number_of(0.3_wp, arithmetic)
      call tally%check(abs(sum%value) < 10*epsilon(1.0_qp), 'a tenth and two are three tenths')
      arithmetic = many_digits(.false.)
      sum = number_of(0.1_wp, arithmetic) + number_of(0.2_wp, arithmetic) - number_of(0.3_wp, arithmetic)
      call tally%near([real(sum%value, wp)], [scale(1.0_wp, -55)], 0.0_wp, 'their doubles are not')
      sum = -(whole(3, arithmetic)*whole(-7, arithmetic))
      call tally%near([real(sum%value, wp)], [21.0_wp], 0.0_wp, 'small whole numbers')
   end subroutine numbers_of_many_digits

   subroutine numbers_modulo_a_prime()
      type(arithmetic_t) :: p
      type(number_t) :: sum

      p = modular_arithmetic(mersenne, .true.)
      call check_residue(number_of(0.1_wp, p), 2075258708292324556_int64, 'a tenth')
      call check_residue(number_of(1.0e-10_wp, p), 1396929604723005925_int64, '1e-10')
      call check_residue(number_of(-0.00039_wp, p), 1348664517658997455_int64, 'a negative decimal')
      call check_residue(number_of(1.0e60_wp, p), 1502961249770472924_int64, 'a power that is not kept')
      call check_residue(number_of(1.0e-60_wp, p), 1074471390397952111_int64, 'one over it')
      call check_residue(number_of(1.0e-60_wp, p)*number_of(1.0e60_wp, p), 1_int64, 'their product')
      call check_residue(number_of(0.0_wp, p), 0_int64, 'zero')
      call check_residue(whole(-3, p), mersenne - 3, 'a negative whole number')
      sum = number_of(0.1_wp, p) + number_of(0.2_wp, p) - number_of(0.3_wp, p)
      call check_residue(sum, 0_int64, 'a tenth and two less three')
      call check_residue(-whole(0, p), 0_int64, 'minus zero')
      call check_residue(-whole(5, p) + whole(7, p), 2_int64, 'seven less five')
      call check_residue(whole(5, p) - whole(7, p), mersenne - 2, 'five less seven')
      call check_residue(whole(-1, p)*whole(-1, p), 1_int64, 'the square of minus one')
   end subroutine numbers_modulo_a_prime

   !> 0.1 is stored as 3602879701896397 / 2**55.
   subroutine doubles_modulo_a_prime()
      type(arithmetic_t) :: p

      p = modular_arithmetic(mersenne, .false.)
      call check_residue(number_of(0.1_wp, p), 230584300921369408_int64, 'the double of a tenth')
      call check_residue(number_of(0.1_wp, p)*number_of(scale(1.0_wp, 55), p), 3602879701896397_int64, 'bit by bit')
      call check_residue(number_of(scale(1.0_wp, -300), p)*number_of(scale(1.0_wp, 300), p), 1_int64, 'far powers of two')
   end subroutine doubles_modulo_a_prime

   subroutine check_residue(number, expected, name)
      type(number_t), intent(in) :: number
      integer(int64), intent(in) :: expected
      character(len=*), intent(in) :: name
      call tally%check(number%modulus == mersenne .and. number%residue == expected, name)
   end subroutine check_residue

   !> By Fermat a**(p - 1) = 1 for every a, which holds for hardly another number.
   subroutine primes()
      integer(int64), parameter :: seeds(*) = [0_int64, 1_int64, -1_int64, 123456789_int64, huge(1_int64)]
      integer(int64) :: prime, found(size(seeds))
      integer :: i, base

      do i = 1, size(seeds)
         prime = random_prime(seeds(i))
         found(i) = prime
         call tally%check(prime > 2_int64**60 .and. prime < 2_int64**61, 'from 2**60 to 2**61')
         call tally%check(random_prime(seeds(i)) == prime, 'the same for the same seed')
         do base = 2, 7
            call tally%check(power(int(base, int64), prime - 1, prime) == 1, 'a prime')
         end do
      end do
      call tally%check(all([(count(found == found(i)) == 1, i=1, size(found))]), 'others for other seeds')
   end subroutine primes

   integer(int64) function power(base, exponent, modulus)
      integer(int64), intent(in) :: base, exponent, modulus
      integer(int64) :: square
      integer :: bit

      power = 1
      square = base
      do bit = 0, 62
         if (btest(exponent, bit)) power = modular_product(power, square, modulus)
         square = modular_product(square, square, modulus)
      end do
   end function power

   !> 1 2 3, 4 5 6, 7 8 9 have rank two; the difference of two residues is what counts.
   subroutine ranks_modulo_a_prime()
      integer(int64) :: entry(3, 3)
      integer :: i

      entry = reshape([(int(i, int64), i=1, 9)], [3, 3])
      call tally%check(dense_modular_rank(3, 3, entry, mersenne) == 2, 'nine numbers in a row')
      entry(3, 3) = entry(3, 3) + 1
      call tally%check(dense_modular_rank(3, 3, entry, mersenne) == 3, 'one of them another')
      call tally%check(dense_modular_rank(2, 3, entry, mersenne) == 2, 'the first rows')
      entry = mersenne - 1
      call tally%check(dense_modular_rank(3, 3, entry, mersenne) == 1, 'all the same')
   end subroutine ranks_modulo_a_prime

   !> Elements of every kind between points of a few digits, with vectors where they take any,
   !> and without where they need none; two pins also where the points coincide.
   subroutine rows_of_every_kind()
      integer :: kind

      do kind = 1, size(element_kinds)
         associate (row => element_kinds(kind))
            if (row%vector /= vector_required) call check_rows(kind, [0.7_wp, -1.3_wp, 0.4_wp], [0.0_wp, 0.0_wp, 0.0_wp])
            if (row%vector /= vector_none) then
               call check_rows(kind, [0.7_wp, -1.3_wp, 0.4_wp], [0.1_wp, 0.2_wp, -0.9_wp])
               call check_rows(kind, [0.7_wp, -1.3_wp, 0.4_wp], [0.0_wp, 0.0_wp, 2.0_wp])
            end if
            call check_rows(kind, [0.0_wp, 0.25_wp, 0.0_wp], merge(1.0_wp, 0.0_wp, row%vector == vector_required) &
                            *[0.3_wp, -0.5_wp, 0.8_wp])
            if (row%needs_length .or. row%slot_kind(1) == 0) cycle
            call check_rows(kind, [0.0_wp, 0.0_wp, 0.0_wp], merge(1.0_wp, 0.0_wp, row%vector == vector_required) &
                            *[0.3_wp, -0.5_wp, 0.8_wp])
         end associate
      end do
   end subroutine rows_of_every_kind

   !> Exact rows are those of the Jacobian but for a positive factor each.
   subroutine check_rows(kind, chord, vector)
      integer, intent(in) :: kind
      real(wp), intent(in) :: chord(3), vector(3)
      type(model_t) :: model
      type(partition_t) :: partition
      type(jacobian_t) :: jacobian
      type(exact_matrix_t) :: exact
      real(wp), allocatable :: dense(:, :), row(:)
      integer :: i, k

      model = one_element(kind, chord, vector)
      call make_partition(model, partition)
      call make_jacobian(model, model%node_value, jacobian)
      allocate (dense(partition%count%rows, partition%count%columns), row(partition%count%columns))
      call fill_dense(jacobian, partition, dense)
      call make_exact_matrix(model, partition, [(i, i=1, size(dense, 1))], many_digits(.true.), exact)
      call tally%check(size(exact%start) == size(dense, 1) + 1, 'as many rows')
      do i = 1, size(dense, 1)
         row = 0.0_wp
         do k = exact%start(i), exact%start(i + 1) - 1
            row(exact%column(k)) = row(exact%column(k)) + real(exact%entry(k)%value, wp)
         end do
         call tally%near(row/norm2(row), dense(i, :)/norm2(dense(i, :)), 1.0e-13_wp, &
                         'exact row of '//element_kinds(kind)%keyword)
      end do
   end subroutine check_rows

   !> All its coordinates are dependent.
   function one_element(kind, chord, vector) result(model)
      integer, intent(in) :: kind
      real(wp), intent(in) :: chord(3), vector(3)
      type(model_t) :: model
      real(wp), parameter :: origin(3) = [0.3_wp, -0.2_wp, 0.9_wp]
      integer :: slot, node(4), nodes

      associate (slot_kind => element_kinds(kind)%slot_kind)
         model = new_model(count(slot_kind /= 0), 1)
         node = 0
         nodes = 0
         do slot = 1, 4
            if (slot_kind(slot) == 0) cycle
            nodes = nodes + 1
            node(slot) = nodes
            select case (slot_kind(slot))
            case (node_position, node_planar_position)
               call set_node(model, nodes, slot_kind(slot), place(slot_kind(slot), origin + merge(1, 0, slot == 3)*chord))
            case (node_orientation)
               call set_node(model, nodes, slot_kind(slot), [0.6_wp, 0.0_wp, 0.8_wp, 0.0_wp])
            case default
               call set_node(model, nodes, slot_kind(slot), [0.4_wp])
            end select
         end do
      end associate
      call set_element(model, 1, kind, node, vector)
   end function one_element

   !> Without z in the plane.
   pure function place(kind, point)
      integer, intent(in) :: kind
      real(wp), intent(in) :: point(3)
      real(wp) :: place(3)
      place = anint(point*1.0e4_wp)/1.0e4_wp
      if (kind == node_planar_position) place(3) = 0.0_wp
   end function place

   function proof_of(model, wish, as_stored) result(proof)
      type(model_t), intent(in) :: model
      integer, intent(in) :: wish
      logical, intent(in), optional :: as_stored
      type(proof_t) :: proof
      type(problem_t) :: problem
      logical :: stored

      stored = .false.
      if (present(as_stored)) stored = as_stored
      call make_problem(model, .false., problem)
      call prove(model, problem, wish, stored, memory, proof)
   end function proof_of

   subroutine nothing_is_proven_unasked()
      type(proof_t) :: proof

      proof = proof_of(twelve_trusses(), prove_never)
      call tally%check(proof%total() == unknown .and. .not. proof%is_complete(), 'no proof')
   end subroutine nothing_is_proven_unasked

   !> Fig. 2 of the paper: one motion and one self-stress.
   subroutine proof_of_twelve_trusses()
      type(proof_t) :: proof

      proof = proof_of(twelve_trusses(), prove_always)
      call tally%check(proof%is_complete() .and. proof%total() == 11, 'twelve trusses')
      call tally%check(proof%as_typed .and. proof%primes == 1, 'of what was typed')
      call tally%check(proof%failure > 0 .and. proof%failure < 1.0e-10_wp, 'which hardly ever fails')
   end subroutine proof_of_twelve_trusses

   !> Bars in a row from a fixed point to another.
   function chain(points) result(model)
      real(wp), intent(in) :: points(:, :)
      type(model_t) :: model
      integer :: i

      model = new_model(size(points, 2), size(points, 2) - 1)
      do i = 1, size(points, 2)
         call set_node(model, i, node_planar_position, points(:, i))
      end do
      call fix(model, [1, size(points, 2)])
      do i = 1, model%elements
         call set_element(model, i, find_element_kind('PLTRUSS'), [i, 0, i + 1, 0])
      end do
   end function chain

   !> Three bars in a line leave what is across it free: rank two. The doubles of these
   !> decimals do not stand in a line.
   subroutine collinear_decimals()
      real(wp), parameter :: points(2, 4) = reshape([0.0_wp, 0.0_wp, 0.1_wp, 0.3_wp, 0.2_wp, 0.6_wp, 0.3_wp, 0.9_wp], [2, 4])
      type(proof_t) :: proof

      proof = proof_of(chain(points), prove_always)
      call tally%check(proof%as_typed .and. proof%total() == 2, 'bars in a line')
      proof = proof_of(chain(points), prove_always, as_stored=.true.)
      call tally%check(.not. proof%as_typed .and. proof%total() == 3, 'where their doubles are what counts')
   end subroutine collinear_decimals

   !> Motions are free across the line, (-3, 1): a motion of y takes x along by minus three.
   !> Forces over lengths are the same in all bars.
   subroutine echelon_of_collinear_decimals()
      real(wp), parameter :: points(2, 4) = reshape([0.0_wp, 0.0_wp, 0.1_wp, 0.3_wp, 0.2_wp, 0.6_wp, 0.3_wp, 0.9_wp], [2, 4])
      type(echelon_t) :: echelon, other

      call find_echelon(chain(points), 0, .false., .false., echelon)
      call tally%check(echelon%as_typed .and. echelon%rank == 2 .and. all(echelon%pivot == [1, 3]), 'two pivots')
      call tally%check(all(echelon%entry(:, 1) == [1, 3, 0, 0]) .and. all(echelon%entry(:, 2) == [0, 0, 1, 3]), 'their rows')
      call find_echelon(chain(points), 1, .false., .true., other)
      call tally%check(other%prime /= echelon%prime, 'another prime')
      call tally%check(other%rank == 2 .and. all(shape(other%entry) == [3, 4]), 'the transpose')
      call tally%check(all(other%entry(3, :2) == other%prime - 1), 'all bars alike')
      call find_echelon(chain(points), 0, .true., .false., echelon)
      call tally%check(.not. echelon%as_typed .and. echelon%rank == 3, 'of doubles')
   end subroutine echelon_of_collinear_decimals

   !> A point that no fifteen digits give: the doubles are what there is, and these decimals
   !> are not in a line among them.
   subroutine collinear_doubles()
      real(wp) :: points(2, 4)
      type(proof_t) :: proof

      points = reshape([0.0_wp, 0.0_wp, 0.1_wp, 0.3_wp, 0.2_wp, 0.6_wp, 0.3_wp, 0.9_wp], [2, 4])
      points(:, 4) = points(:, 4)*sqrt(2.0_wp)
      proof = proof_of(chain(points), prove_always)
      call tally%check(.not. proof%as_typed .and. proof%total() == 3, 'bars not quite in a line')
      ! Powers of two apart, doubles of any number are in a line.
      points = spread([0.0_wp, 1.0_wp, 2.0_wp, 4.0_wp], 1, 2)
      points = points*spread([sqrt(2.0_wp), sqrt(3.0_wp)], 2, 4)
      proof = proof_of(chain(points), prove_always)
      call tally%check(.not. proof%as_typed .and. proof%total() == 2, 'bars in a line of doubles')
   end subroutine collinear_doubles
end program test_exact
