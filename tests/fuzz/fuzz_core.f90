! SPDX-License-Identifier: BSD-3-Clause
!> Takes decks through all of the core as Python does, to be built with sanitizers: reads them,
!> and checks, assembles and analyses what they hold. The argument names a file with the path of
!> a deck a line; each path is printed before its deck is taken.
program fuzz_core
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_int, c_double, c_signed_char
   use flexact_result, only: most_pairs
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
      integer(c_int) :: sizes(7), diag_count(4), diag_number(8, 100)
      integer(c_signed_char), allocatable :: diag_text(:, :, :)
      integer(c_int), allocatable :: nodes(:, :), elements(:, :), element_name(:, :), node_name(:, :), look(:, :)
      real(c_double), allocatable :: places(:, :), vectors(:, :), of_element(:, :, :), of_node(:, :, :)
      real(c_double) :: gravity(3)
      integer :: n, nn, ne

      n = size(text)
      ne = min(count(text == 10) + 1, n/10 + 1)
      nn = min(4*ne, n/2 + 4)
      allocate (nodes(5, nn), elements(12, ne), places(4, nn), vectors(3, ne))
      allocate (element_name(2, ne), node_name(2, nn), look(ne, 2), of_element(6, ne, 6), of_node(6, nn, 3))
      allocate (diag_text(240, 4, 100))
      call read_deck(n, text, nn, ne, nn, ne, nodes, places, elements, vectors, element_name, node_name, &
                     look(:, 1), look(:, 2), of_element(:2, :, 1), of_element(:3, :, 2), of_element(:3, :, 3), &
                     of_element(1, :, 4), of_element(:, :, 5), of_element(:5, :, 6), of_node(:, :, 1), &
                     of_node(:3, :, 2), of_node(:3, :, 3), sizes(1), sizes(2), sizes(3), sizes(4), sizes(5), &
                     sizes(6), sizes(7), gravity, diag_count, diag_number, diag_text)
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
      integer(c_int), allocatable :: index(:, :), place(:), pair(:, :), owner(:, :)
      real(c_double), allocatable :: value(:), by_size(:, :), effect(:, :)
      real(c_double) :: facts(48)
      integer(c_int) :: stage(3), used
      integer :: most, room, i, pairs

      stage = 0
      most = 3*size(nodes, 2) + 6*size(elements, 2)
      room = max(1, most*most)
      allocate (index(3, most + 1), place(room), value(room), by_size(most, 8))
      call analyse_model(most, room, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, &
                         [real(c_double) :: method, -1, 1.0e9, 0, 0, 0], stage, index, place, value, by_size, facts)
      if (nint(facts(1)) /= 0) return
      pairs = nint(facts(24))
      if (pairs == 0) return
      allocate (pair(2, pairs), owner(2, pairs), effect(5, pairs))
      do i = 1, pairs
         pair(:, i) = i
      end do
      call find_sensitivities(sum(sizes), pairs, pairs, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, &
                              by_size(:sum(sizes), 3:pairs + 2), pair, effect, owner, used)
   end subroutine take_analysis

   !> The model as it is, and stretched more and more; then with all deformations held.
   subroutine take_variants(nodes, places, elements, vectors)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, parameter :: variants = 4, room = size(variant_fact_names) + 3*most_pairs
      real(c_double), allocatable :: positions(:, :, :), facts(:, :)
      integer(c_int), allocatable :: classes(:, :, :)
      real(c_double) :: wishes(11)
      integer :: i, with_values

      allocate (positions(3, size(nodes, 2), variants), classes(6, size(elements, 2), variants), facts(room, variants))
      do i = 1, variants
         positions(:, :, i) = places(:3, :)*spread([1.0_c_double, 0.5_c_double + i, 1.0_c_double/i], 2, size(nodes, 2))
         classes(:, :, i) = merge(min(elements(7:, :), 1), elements(7:, :), i == variants)
      end do
      wishes = [real(c_double) :: 10, 10, 0.01, 0, 1.0e9, 0, 0, 8, 6, 1.0e6, 1.0e-9]
      do with_values = 0, 1
         wishes(4) = with_values
         call analyse_variants(room, variants, size(nodes, 2), size(elements, 2), variants, variants, nodes, places, elements, &
                               vectors, wishes, positions, classes, facts)
      end do
   end subroutine take_variants

   subroutine take_echelon(nodes, places, elements, vectors, n, transposed)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, intent(in) :: n, transposed
      integer(c_int), allocatable :: pivot(:), place(:, :)
      integer(c_int) :: facts(5)

      if (n == 0) return
      allocate (pivot(n), place(4, n*n/4 + 1))
      call find_echelon(n, n*n/4 + 1, size(nodes, 2), size(elements, 2), nodes, places, elements, vectors, &
                        [0, 0, transposed], pivot, place, facts)
   end subroutine take_echelon

   !> Every element with some stiffness and mass, under its weight, and what may be asked of it there.
   subroutine take_elastic(nodes, places, elements, vectors)
      integer(c_int), intent(in) :: nodes(:, :), elements(:, :)
      real(c_double), intent(in) :: places(:, :), vectors(:, :)
      integer, parameter :: asked = 5
      real(c_double), allocatable :: of_nodes(:, :), of_elements(:, :), stiffness(:, :, :), c_t(:), given(:, :), answer(:, :)
      real(c_double) :: gravity(3, 2), facts(6), found(5), configuration(4, size(nodes, 2)), reaction(3, size(nodes, 2))
      real(c_double) :: stress(6, size(elements, 2))
      integer :: nn, ne, n, task

      nn = size(nodes, 2)
      ne = size(elements, 2)
      n = 6*(nn + ne) + 1
      allocate (of_nodes(27, nn), of_elements(35, ne), source=0.0_c_double)
      allocate (stiffness(6, 6, ne), c_t(ne), given(n, 2), answer(n, 3*asked))
      of_nodes(:6, :) = ieee_value(1.0_c_double, ieee_quiet_nan)
      of_nodes([7, 14, 21], :) = spread(places(1, :), 1, 3)
      of_nodes([8, 15, 22], :) = spread(places(2, :), 1, 3)
      of_nodes([9, 16, 23], :) = spread(places(3, :), 1, 3)
      of_nodes([10, 17, 24], :) = spread(places(4, :), 1, 3)
      of_elements(:17, :) = ieee_value(1.0_c_double, ieee_quiet_nan)
      of_elements(:4, :) = spread([real(c_double) :: 1.0e6, 1, 2, 3], 2, ne)
      of_elements(7, :) = 0.1_c_double
      gravity(:, 1) = 0
      gravity(:, 2) = [real(c_double) :: 0, 0, -9.81]
      call find_stiffness(nn, ne, nodes, places, elements, vectors, of_elements(:17, :), stiffness, c_t)
      call follow_path(nn, ne, nodes, places, elements, vectors, of_nodes, of_elements, gravity, configuration, &
                       reaction, stress, facts)
      of_nodes(7:10, :) = configuration
      of_nodes(11:13, :) = reaction
      of_elements(18:23, :) = stress
      given = 1
      do task = 1, 4
         if (task == 4) given(1, :) = [0, -1]
         call study_state(n, 2, 3*asked, nn, ne, nodes, places, elements, vectors, of_nodes(:13, :), of_elements(:23, :), &
                          [real(c_double) :: task, asked, gravity(:, 2)], given, answer, found)
      end do
   end subroutine take_elastic

   ! Here, so that the compiler holds the calls above against them.
   include '../../fortran/boundary/bindings.f90'
end program fuzz_core
