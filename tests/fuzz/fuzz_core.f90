! SPDX-License-Identifier: BSD-3-Clause
!> Takes decks through all of the core as Python does, to be built with sanitizers: reads them,
!> and checks, assembles and analyses what they hold. The argument names a file with the path of
!> a deck a line; each path is printed before its deck is taken.
program fuzz_core
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_int, c_double, c_signed_char
   use flexact_result, only: most_pairs
   use flexact_result_exchange, only: fact_names
   use flexact_variant_exchange, only: variant_fact_names
   implicit none
   !> Larger models are read, but not analysed.
   integer, parameter :: most_deformations = 300
   integer, parameter :: methods = 4

   call main()

contains

   subroutine main()
      character(len=4096) :: list, path
      integer :: unit, status

      call get_command_argument(1, list)
      open (newunit=unit, file=list, status='old', action='read')
      do
         read (unit, '(a)', iostat=status) path
         if (status /= 0) exit
         write (*, '(a)') trim(path)
         flush (6)
         call take_file(trim(path))
      end do
      close (unit)
   end subroutine main

   subroutine take_file(path)
      character(len=*), intent(in) :: path
      integer(c_signed_char), allocatable :: text(:)
      integer :: unit, bytes

      open (newunit=unit, file=path, status='old', action='read', access='stream', form='unformatted')
      inquire (unit, size=bytes)
      allocate (text(bytes))
      if (bytes > 0) read (unit) text
      close (unit)
      if (bytes > 0) call take_deck(text)
   end subroutine take_file

   !> As flexact.core.calls.read_deck sets the room aside.
   subroutine take_deck(text)
      integer(c_signed_char), intent(in) :: text(:)
      integer(c_int) :: sizes(8), diag_count(4), diag_number(8, 100)
      integer(c_signed_char), allocatable :: diag_text(:, :, :)
      integer(c_int), allocatable :: nodes(:, :), elements(:, :), element_name(:, :), node_name(:, :), look(:, :)
      real(c_double), allocatable :: places(:, :), vectors(:, :), of_element(:, :, :), of_node(:, :, :)
      real(c_double) :: gravity(3)
      integer :: n, nn, ne

      n = size(text)
      ne = min(count(text == 10) + 1, n/10 + 1)
      nn = min(4*ne, n/2 + 4)
      allocate (nodes(5, nn), elements(12, ne), places(4, nn), vectors(3, ne))
      allocate (element_name(2, ne), node_name(2, nn), look(ne, 2), of_element(6, ne, 9), of_node(6, nn, 3))
      allocate (diag_text(240, 4, 100))
      call read_deck(n, text, nn, ne, nn, ne, nodes, places, elements, vectors, element_name, node_name, &
                     look(:, 1), look(:, 2), of_element(:2, :, 1), of_element(:3, :, 2), of_element(:3, :, 3), &
                     of_element(1, :, 4), of_element(:, :, 5), of_element(:5, :, 6), of_element(:2, :, 7), of_element(:1, :, 8), &
                     of_element(:1, :, 9), of_node(:, :, 1), of_node(:3, :, 2), of_node(:3, :, 3), sizes(1), sizes(2), &
                     sizes(3), sizes(4), sizes(5), sizes(6), sizes(7), sizes(8), gravity, diag_count, diag_number, diag_text)
      if (diag_count(1) > 0) return
      nn = sizes(1)
      ne = sizes(2)
      call take_model(text, nodes(:, :nn), places(:, :nn), elements(:, :ne), vectors(:, :ne), &
                      reshape([element_name(:, :ne), node_name(:, :nn)], [2, ne + nn]))
   end subroutine take_deck

   subroutine take_model(text, nodes, places, elements, vectors, name)
      integer(c_signed_char), intent(in) :: text(:)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :), name(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer(c_int) :: counts(4, 2), sizes(2), diag_count(4), diag_number(8, 100), used
      integer(c_signed_char), allocatable :: diag_text(:, :, :)
      integer(c_int), allocatable :: place(:, :)
      real(c_double), allocatable :: frame(:, :, :), length(:), deformation(:, :), entry(:)
      integer :: nn, ne, method

      nn = size(nodes, 2)
      ne = size(elements, 2)
      allocate (diag_text(240, 4, 100), frame(3, 3, ne), length(ne), deformation(6, ne), place(2, 72*ne), entry(72*ne))
      call check_model(size(text), text, nn, ne, nodes, places, elements, vectors, name, diag_count, diag_number, diag_text)
      call count_model(nn, ne, nodes, elements, counts, sizes)
      call find_frames(nn, ne, nodes, places, elements, vectors, frame, length)
      call assemble(72*ne, nn, ne, nodes, places, elements, vectors, places, [real(c_double) :: spread(0.0, 1, ne)], &
                    deformation, place, entry, used)
      if (sum(counts(:1, 2)) > most_deformations) return
      do method = 0, methods - 1
         call take_analysis(nodes, places, elements, vectors, sizes, method)
      end do
      call take_variants(nodes, places, elements, vectors)
      call take_elastic(nodes, places, elements, vectors)
      call take_echelon(nodes, places, elements, vectors, sizes(2), 0)
      call take_echelon(nodes, places, elements, vectors, sizes(1), 1)
   end subroutine take_model

   !> An analysis, and what changes of the geometry make of the pairs that it found.
   subroutine take_analysis(nodes, places, elements, vectors, sizes, method)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :), sizes(2)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, intent(in) :: method
      integer(c_int), allocatable :: label(:, :), first(:), place(:), pair(:, :), owner(:, :)
      real(c_double), allocatable :: value(:), scale(:), scaled_value(:), pair_vector(:, :), effect(:, :)
      real(c_double) :: facts(size(fact_names)), pair_value(most_pairs)
      integer(c_int) :: stage(3), used
      integer :: most, room, i, pairs

      stage = 0
      most = 3*size(nodes, 2) + 6*size(elements, 2)
      room = max(1, most*most)
      allocate (label(2, most), first(most + 1), place(room), value(room), scale(most), scaled_value(most))
      allocate (pair_vector(most, most_pairs))
      call analyse_model(most, room, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, method, -1.0_c_double, &
                         1.0e9_c_double, 0, 0, 0, stage, label, first, place, value, scale, scaled_value, pair_vector, facts, &
                         pair_value)
      if (nint(facts(1)) /= 0) return
      pairs = nint(facts(24))
      if (pairs == 0) return
      allocate (pair(2, pairs), owner(2, pairs), effect(5, pairs))
      do i = 1, pairs
         pair(:, i) = i
      end do
      call find_sensitivities(sum(sizes), pairs, pairs, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, &
                              pair_vector(:sum(sizes), :pairs), pair, effect, owner, used)
   end subroutine take_analysis

   !> The model as it is, and stretched more and more; then with all deformations held.
   subroutine take_variants(nodes, places, elements, vectors)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, parameter :: variants = 4
      real(c_double), allocatable :: positions(:, :, :)
      real(c_double) :: facts(size(variant_fact_names), variants)
      real(c_double), dimension(most_pairs, variants) :: pair_value, by_move, by_turn
      integer(c_int), allocatable :: classes(:, :, :)
      integer :: i, with_values

      allocate (positions(3, size(nodes, 2), variants), classes(6, size(elements, 2), variants))
      do i = 1, variants
         positions(:, :, i) = places(:3, :)*spread([1.0_c_double, 0.5_c_double + i, 1.0_c_double/i], 2, size(nodes, 2))
         classes(:, :, i) = merge(min(elements(7:, :), 1), elements(7:, :), i == variants)
      end do
      do with_values = 0, 1
         call analyse_variants(variants, size(nodes, 2), size(elements, 2), variants, variants, nodes, places, elements, vectors, &
                               10.0_c_double, 10.0_c_double, 0.01_c_double, with_values, 1.0e9_c_double, 0, 0, [8, 6], &
                               [1.0e6_c_double, 1.0e-9_c_double], positions, classes, facts, pair_value, by_move, by_turn)
      end do
   end subroutine take_variants

   subroutine take_echelon(nodes, places, elements, vectors, n, transposed)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, intent(in) :: n, transposed
      integer(c_int), allocatable :: pivot(:), entry(:, :)
      integer(c_int) :: prime(2), as_typed, used

      if (n == 0) return
      allocate (pivot(n), entry(4, n*n/4 + 1))
      call find_echelon(n, n*n/4 + 1, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, &
                        0, 0, transposed, pivot, entry, prime, as_typed, used)
   end subroutine take_echelon

   !> Every element with some stiffness and mass, under its weight, and what may be asked of it there.
   subroutine take_elastic(nodes, places, elements, vectors)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, parameter :: asked = 5
      real(c_double), dimension(6, size(elements, 2)) :: stiffness, notch, stress
      real(c_double) :: mass(5, size(elements, 2)), element_stiffness(6, 6, size(elements, 2)), c_t(size(elements, 2))
      real(c_double) :: node_mass(6, size(nodes, 2)), configuration(4, size(nodes, 2)), reaction(3, size(nodes, 2))
      real(c_double), dimension(3, size(nodes, 2), 2) :: force, shift, displacement, reactions
      real(c_double), dimension(6, size(elements, 2), 2) :: misfit, stresses
      real(c_double) :: loose(3, size(nodes, 2), asked), mode(3, size(nodes, 2), asked), value(asked)
      real(c_double) :: pair(2), below(2, 2), above(2, 2)
      real(c_double) :: gravity(3, 2), reached, residual, reduced(2, 2, 3)
      integer(c_int) :: status, iterations, steps, place, found, unheld, negative, complete, failed
      integer :: nn, ne, of_buckling

      nn = size(nodes, 2)
      ne = size(elements, 2)
      node_mass = ieee_value(1.0_c_double, ieee_quiet_nan)
      stiffness = ieee_value(1.0_c_double, ieee_quiet_nan)
      mass = ieee_value(1.0_c_double, ieee_quiet_nan)
      notch = ieee_value(1.0_c_double, ieee_quiet_nan)
      stiffness(:4, :) = spread([real(c_double) :: 1.0e6, 1, 2, 3], 2, ne)
      mass(1, :) = 0.1_c_double
      configuration = places
      reaction = 0
      stress = 0
      force = 0
      misfit = 0
      gravity(:, 1) = 0
      gravity(:, 2) = [real(c_double) :: 0, 0, -9.81]
      call find_stiffness(nn, ne, nodes, places, elements, vectors, stiffness, notch, element_stiffness, c_t)
      call follow_path(nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                       reaction, spread(places, 3, 2), misfit, force, gravity, status, reached, iterations, steps, residual, place)
      force = 1
      misfit = 1
      shift = 1
      call find_response(2, asked, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, &
                         stress, reaction, gravity(:, 2), force, misfit, shift, displacement, stresses, reactions, pair, loose, &
                         unheld, negative, failed)
      do of_buckling = 0, 1
         call find_modes(asked, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, &
                         stress, reaction, gravity(:, 2), of_buckling, value, mode, found, unheld, negative, complete, failed)
      end do
      call find_matrices(2, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                         reaction, gravity(:, 2), [0, -1], reduced(:, :, 1), reduced(:, :, 2), reduced(:, :, 3), complete, failed)
      call find_errors(2, 2, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                       reaction, gravity(:, 2), [0.0_c_double, 1.0e4_c_double], misfit, [1.0_c_double, 2.0_c_double], below, &
                       above, unheld, negative, failed)
   end subroutine take_elastic

   ! Here, so that the compiler holds the calls above against them.
   include '../../fortran/boundary/bindings.f90'
end program fuzz_core
