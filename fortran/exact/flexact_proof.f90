! SPDX-License-Identifier: BSD-3-Clause
!> The rank of D(c) in exact arithmetic, component by component. Every row is rational
!> in the numbers of the model up to a factor, so that its rank modulo a prime is
!> never above its rank, and below it only where the prime divides all of its largest
!> minors; theory.md (17) and (18).
module flexact_proof
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_components, only: components_t, component_of_columns, shape_of
   use flexact_exact_matrix, only: exact_matrix_t, make_exact_matrix
   use flexact_exact_number, only: arithmetic_t, number_t, modular_arithmetic, number_of
   use flexact_modular, only: random_prime
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_modular_rank, only: modular_rank, limits_t, too_much_work
   use flexact_problem, only: problem_t
   use flexact_rounding, only: typed_t, typed
   implicit none
   private
   public :: proof_t, prove, no_proof, all_typed, seed_of
   public :: prove_by_cost, prove_always, prove_never, proof_names, unknown

   integer, parameter :: prove_by_cost = 0, prove_always = 1, prove_never = 2
   character(len=24), parameter :: proof_names(0:2) = [character(len=24) :: 'by cost', 'always', 'never']
   !> A rank that is not known.
   integer, parameter :: unknown = -1

   !> Up to so many rows and columns a proof costs some hundredths of a second, if each
   !> component takes no more multiplications than a square of 300 columns in full.
   integer, parameter :: cheap_size = 40000
   real(wp), parameter :: cheap_work = 2.7e7_wp
   !> And so many where a proof is asked for, some minutes each.
   real(wp), parameter :: most_work = 2.0e10_wp
   !> Bytes for each row, its entries and their elimination.
   real(wp), parameter :: bytes_of_row = 2000.0_wp
   !> Primes from 2**60 to 2**61 are at least 3/5 of 2**60 over its logarithm (Rosser
   !> and Schoenfeld, Illinois J. Math. 6, 1962, corollary 3 of theorem 2).
   real(wp), parameter :: primes_at_hand = 0.6_wp*2.0_wp**60/41.6_wp
   real(wp), parameter :: bits_of_prime = 60.0_wp
   !> Entries are of at most this degree in the offsets, and in the vectors; sums and
   !> the norm of a row add a few bits.
   integer, parameter :: degree = 3
   real(wp), parameter :: bits_of_sums = 8.0_wp

   type :: proof_t
      !> Of each component of D(c); -1 where it is not known.
      integer, allocatable :: rank(:)
      !> Of the decimals as typed, or of the doubles as stored.
      logical :: as_typed = .true.
      integer :: primes = 0
      logical :: is_too_large = .false.
      !> That some rank is too low has at most this probability, over seeds: theory.md (18).
      real(wp) :: failure = 0.0_wp
   contains
      procedure :: is_complete
      procedure :: total
   end type proof_t

contains

   pure logical function is_complete(proof)
      class(proof_t), intent(in) :: proof
      is_complete = all(proof%rank /= unknown) .and. proof%primes > 0
   end function is_complete

   pure integer function total(proof)
      class(proof_t), intent(in) :: proof
      total = merge(sum(proof%rank), unknown, proof%is_complete())
   end function total

   !> Nothing is known of any component.
   pure subroutine no_proof(components, proof)
      integer, intent(in) :: components
      type(proof_t), intent(out) :: proof
      allocate (proof%rank(components), source=unknown)
   end subroutine no_proof

   !> wish: one of those above. as_stored: numbers are no decimals, whatever they look like.
   !> memory: bytes that may be used.
   subroutine prove(model, problem, wish, as_stored, memory, proof)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: wish
      logical, intent(in) :: as_stored
      real(wp), intent(in) :: memory
      type(proof_t), intent(out) :: proof
      type(arithmetic_t) :: arithmetic
      type(number_t), allocatable :: node_place(:, :)
      integer, allocatable :: place(:), component_of(:)
      logical, allocatable :: is_joined(:)
      type(limits_t) :: limits
      real(wp) :: bits_of_row
      integer :: i

      call no_proof(problem%components%count, proof)
      proof%as_typed = all_typed(model) .and. .not. as_stored
      if (wish == prove_never) return
      associate (rows => problem%partition%count%rows, columns => problem%partition%count%columns)
         proof%is_too_large = bytes_of_row*rows > memory .or. (wish == prove_by_cost .and. rows + columns > cheap_size)
      end associate
      if (proof%is_too_large) return
      limits = limits_t(merge(most_work, cheap_work, wish == prove_always), memory/16)
      allocate (is_joined(problem%components%count), source=.false.)
      place = places_in_components(problem%components)
      component_of = component_of_columns(problem%components)
      bits_of_row = row_bits(model, proof%as_typed)
      proof%primes = 1
      arithmetic = modular_arithmetic(random_prime(seed_of(model)), proof%as_typed)
      node_place = number_of(model%node_value(:3, :), arithmetic)
      do i = 1, problem%components%count
         associate (sides => shape_of(problem%components, i))
            call prove_component(model, problem, i, arithmetic, node_place, limits, place, component_of, is_joined, &
                                 proof)
            if (proof%rank(i) >= 0 .and. proof%rank(i) < minval(sides)) &
               proof%failure = proof%failure + minval(sides)*bits_of_row/bits_of_prime/primes_at_hand
         end associate
      end do
      where (is_joined) proof%rank = unknown
   end subroutine prove

   !> Where each column of D(c) stands in its component.
   pure function places_in_components(components) result(place)
      type(components_t), intent(in) :: components
      integer :: place(size(components%column)), i, j

      do i = 1, components%count
         associate (first => components%column_start(i), last => components%column_start(i + 1) - 1)
            place(components%column(first:last)) = [(j, j=1, last - first + 1)]
         end associate
      end do
   end function places_in_components

   pure subroutine prove_component(model, problem, i, arithmetic, node_place, limits, place, component_of, is_joined, &
                                   proof)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i, place(:), component_of(:)
      type(arithmetic_t), intent(in) :: arithmetic
      type(number_t), intent(in) :: node_place(:, :)
      type(limits_t), intent(in) :: limits
      logical, intent(inout) :: is_joined(:)
      type(proof_t), intent(inout) :: proof
      type(exact_matrix_t) :: matrix
      integer :: sides(2), k

      sides = shape_of(problem%components, i)
      proof%rank(i) = 0
      if (any(sides == 0)) return
      associate (c => problem%components)
         call make_exact_matrix(model, problem%partition, c%row(c%row_start(i):c%row_start(i + 1) - 1), arithmetic, matrix, &
                                node_place)
      end associate
      ! What rounding made zero may join components: they are not two then.
      do k = 1, size(matrix%column)
         associate (other => component_of(matrix%column(k)))
            if (other /= i) is_joined([i, other]) = .true.
         end associate
      end do
      if (is_joined(i)) return
      matrix%column = place(matrix%column)
      proof%rank(i) = modular_rank(matrix%start, matrix%column, matrix%entry%residue, sides(2), arithmetic%modulus, limits)
      if (proof%rank(i) == too_much_work) proof%rank(i) = unknown
   end subroutine prove_component

   !> Whether fifteen digits give every number of the geometry.
   pure logical function all_typed(model)
      type(model_t), intent(in) :: model
      integer :: k, slot

      all_typed = .false.
      do k = 1, model%elements
         if (any(.not. is_short(model%element_vector(:, k)))) return
         do slot = 1, 3, 2
            if (model%element_node(slot, k) == 0) cycle
            if (any(.not. is_short(model%node_value(:3, model%element_node(slot, k))))) return
         end do
      end do
      all_typed = .true.
   end function all_typed

   elemental logical function is_short(value)
      real(wp), intent(in) :: value
      type(typed_t) :: parts
      parts = typed(value)
      is_short = parts%short
   end function is_short

   !> Bits of the norm of any row, where the numbers are made whole.
   pure real(wp) function row_bits(model, as_typed)
      type(model_t), intent(in) :: model
      logical, intent(in) :: as_typed
      real(wp) :: bits

      bits = bits_to_store(model%node_value(:3, :), as_typed) + 1 + bits_to_store(model%element_vector, as_typed)
      row_bits = degree*bits + bits_of_sums
   end function row_bits

   !> Of the largest of some numbers, all made whole by one factor.
   pure real(wp) function bits_to_store(value, as_typed) result(bits)
      real(wp), intent(in) :: value(:, :)
      logical, intent(in) :: as_typed
      real(wp) :: largest, smallest
      integer :: lost

      bits = 1.0_wp
      if (.not. any(abs(value) > 0)) return
      largest = maxval(abs(value))
      smallest = minval(abs(value), abs(value) > 0)
      ! A decimal of 15 digits is whole after 15 places, a double after 53 bits.
      lost = merge(52, 53, as_typed)
      bits = max(1.0_wp, exponent(largest) - exponent(smallest) + lost + 1.0_wp)
   end function bits_to_store

   !> A number that a change of the model changes.
   pure integer(int64) function seed_of(model) result(seed)
      type(model_t), intent(in) :: model
      integer :: k, i

      seed = 0
      do k = 1, model%nodes
         do i = 1, 3
            seed = ieor(ishftc(seed, 5), transfer(model%node_value(i, k), seed))
            seed = ieor(ishftc(seed, 3), int(model%coordinate_class(i, k), int64))
         end do
      end do
      do k = 1, model%elements
         do i = 1, 3
            seed = ieor(ishftc(seed, 5), transfer(model%element_vector(i, k), seed))
         end do
         do i = 1, 4
            seed = ieor(ishftc(seed, 3), int(model%element_node(i, k), int64))
         end do
      end do
   end function seed_of
end module flexact_proof
