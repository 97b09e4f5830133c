! SPDX-License-Identifier: BSD-3-Clause
! What Python can call: flat procedures, C types, explicit shapes, no state.
!
! f2py reads this file alone. Kinds are spelt c_int, c_double, c_signed_char because f2py turns
! other named kinds into single precision without a word. "threadsafe" drops the interpreter
! lock: a call is a function of its arguments. A model crosses as flexact_exchange packs it.

! One row of the element table: keyword, synonym, what it is, numbers of ESTIFF and of EM; slots,
! frame, vector, 1 if p and q must be apart, member, roles and duals of the deformations. count: rows.
subroutine describe_element(kind, words, numbers, count)
   use iso_c_binding
   use flexact_element_table, only: element_kinds
   use flexact_exchange, only: from_text
   use flexact_roles, only: dual_of
   implicit none
   integer(c_int), intent(in) :: kind
   integer(c_signed_char), intent(out) :: words(224, 5)
   integer(c_int), intent(out) :: numbers(20), count

   count = size(element_kinds)
   associate (row => element_kinds(min(max(kind, 1), count)))
      call from_text(row%keyword, words(:, 1))
      call from_text(row%synonym, words(:, 2))
      call from_text(row%says, words(:, 3))
      call from_text(row%stiffness, words(:, 4))
      call from_text(row%mass, words(:, 5))
      numbers = [row%slot_kind, row%frame, row%vector, merge(1, 0, row%needs_length), row%member, row%role, dual_of(row%role)]
   end associate
end subroutine describe_element

! The names of an enumeration of the core, from its first value on; count 0
! where there is no such enumeration.
subroutine describe_names(n, enumeration, names, first, count)
   use iso_c_binding
   use flexact_names, only: give_names
   implicit none
   integer(c_int), intent(in) :: n
   integer(c_signed_char), intent(in) :: enumeration(n)
   integer(c_signed_char), intent(out) :: names(24, 128)
   integer(c_int), intent(out) :: first, count

   call give_names(enumeration, names, first, count)
end subroutine describe_names

! Read a deck. What it holds is given where there is room for it, how many nodes and elements it
! has in any case; so is whether it is planar and has more digits than its numbers hold, and whether
! it says how elements are drawn, their stiffness or mass, and loads, of which the other arrays are.
subroutine read_deck(n, text, most_nodes, most_elements, valued_nodes, valued_elements, nodes, places, elements, vectors, &
                     element_name, node_name, cross_section, drawn, dimensions, colour, edge_colour, opacity, &
                     stiffness, mass, node_mass, force, increment, node_count, element_count, is_planar, has_long_numbers, &
                     has_appearance, has_properties, has_loads, gravity, diag_count, diag_number, diag_text)
   use iso_c_binding
   use flexact_deck, only: read_text => read_deck
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: diagnostics_t
   use flexact_deck_exchange, only: give_sizes, give_model, give_appearance, give_properties, give_loads
   use flexact_exchange, only: to_text, give_diagnostics
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, most_nodes, most_elements, valued_nodes, valued_elements
   integer(c_signed_char), intent(in) :: text(n)
   integer(c_int), intent(inout) :: nodes(5, most_nodes), elements(12, most_elements)
   real(c_double), intent(inout) :: places(4, most_nodes), vectors(3, most_elements)
   integer(c_int), intent(inout) :: element_name(2, most_elements), node_name(2, most_nodes)
   integer(c_int), intent(inout) :: cross_section(valued_elements), drawn(valued_elements)
   real(c_double), intent(inout) :: dimensions(2, valued_elements), colour(3, valued_elements)
   real(c_double), intent(inout) :: edge_colour(3, valued_elements), opacity(valued_elements)
   real(c_double), intent(inout) :: stiffness(6, valued_elements), mass(5, valued_elements), node_mass(6, valued_nodes)
   real(c_double), intent(inout) :: force(3, valued_nodes), increment(3, valued_nodes)
   integer(c_int), intent(out) :: node_count, element_count, is_planar, has_long_numbers
   integer(c_int), intent(out) :: has_appearance, has_properties, has_loads
   real(c_double), intent(out) :: gravity(3)
   integer(c_int), intent(out) :: diag_count(4), diag_number(8, 100)
   integer(c_signed_char), intent(out) :: diag_text(240, 4, 100)
   character(len=:), allocatable :: letters
   type(deck_model_t) :: deck
   type(diagnostics_t) :: diagnostics
   integer :: unused

   call to_text(text, letters)
   call read_text(letters, deck, unused, diagnostics)
   call give_diagnostics(letters, diagnostics, diag_count, diag_number, diag_text)
   node_count = 0
   element_count = 0
   is_planar = 0
   has_long_numbers = 0
   has_appearance = 0
   has_properties = 0
   has_loads = 0
   gravity = 0
   if (diagnostics%has_errors()) return
   call give_sizes(deck, node_count, element_count, is_planar, has_long_numbers, has_appearance, has_properties, has_loads)
   if (node_count <= most_nodes .and. element_count <= most_elements) &
      call give_model(deck, nodes, places, elements, vectors, element_name, node_name)
   if (node_count > valued_nodes .or. element_count > valued_elements) return
   call give_appearance(deck, cross_section, drawn, dimensions, colour, edge_colour, opacity)
   call give_properties(deck, stiffness, mass, node_mass)
   call give_loads(deck, force, increment, gravity)
end subroutine read_deck

! The lines of a deck and their words, as read_tokens says; of both there is room for all.
subroutine find_tokens(n, text, line_count, word_count, lines, words)
   use iso_c_binding
   use flexact_exchange, only: to_text
   use flexact_tokens, only: read_tokens
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, line_count, word_count
   integer(c_signed_char), intent(in) :: text(n)
   integer(c_int), intent(inout) :: lines(7, line_count), words(5, word_count)
   character(len=:), allocatable :: letters

   call to_text(text, letters)
   call read_tokens(letters, lines, words)
end subroutine find_tokens

! Check a model that was made without a deck. name: where in the text the names of the
! elements stand, then those of the nodes.
subroutine check_model(n, text, nn, ne, nodes, places, elements, vectors, name, diag_count, diag_number, diag_text)
   use iso_c_binding
   use flexact_diagnostics, only: diagnostics_t
   use flexact_exchange, only: give_diagnostics
   use flexact_model_check, only: check => check_made_model
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, nn, ne, nodes(5, nn), elements(12, ne), name(2, ne + nn)
   integer(c_signed_char), intent(in) :: text(n)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne)
   integer(c_int), intent(out) :: diag_count(4), diag_number(8, 100)
   integer(c_signed_char), intent(out) :: diag_text(240, 4, 100)
   type(diagnostics_t) :: diagnostics

   call check(nodes, places, elements, vectors, text, name, diagnostics)
   call give_diagnostics('', diagnostics, diag_count, diag_number, diag_text)
end subroutine check_model

! Counts (coordinates, deformations; total, fixed, dependent, independent), and
! rows and columns of D(c).
subroutine count_model(nn, ne, nodes, elements, counts, sizes)
   use iso_c_binding
   use flexact_exchange, only: counts_of
   use flexact_partition, only: count => count_model, model_count_t
   implicit none
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   integer(c_int), intent(out) :: counts(4, 2), sizes(2)
   type(model_count_t) :: total

   total = count(nodes(3:5, :), elements(7:12, :))
   counts(:, 1) = counts_of(total%coordinates)
   counts(:, 2) = counts_of(total%deformations)
   sizes = [total%rows, total%columns]
end subroutine count_model

! The reference frame of each element, axes as columns, and its length l0 [m].
subroutine find_frames(nn, ne, nodes, places, elements, vectors, frame, length)
   use iso_c_binding
   use flexact_geometry_exchange, only: give_frames
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne)
   real(c_double), intent(out) :: frame(3, 3, ne), length(ne)

   call give_frames(nodes, places, elements, vectors, frame, length)
end subroutine find_frames

! Deformations and the whole Jacobian in a configuration; entry i stands at place(:, i),
! counted from 0: 6*element + deformation, 3*node + axis. used: its entries.
subroutine assemble(entries, nn, ne, nodes, places, elements, vectors, configuration, c_t, deformation, place, value, used)
   use iso_c_binding
   use flexact_geometry_exchange, only: give_jacobian
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: entries, nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), configuration(4, nn), c_t(ne)
   real(c_double), intent(out) :: deformation(6, ne)
   integer(c_int), intent(inout) :: place(2, entries)
   real(c_double), intent(inout) :: value(entries)
   integer(c_int), intent(out) :: used

   call give_jacobian(nodes, places, elements, vectors, configuration, c_t, deformation, place, value, used)
end subroutine assemble

! Rank, motions and self-stresses in the reference configuration; what comes back, and what
! wishes are, as run_with_blas says. n: rows and columns, at least 1. stage: work, per cent, not 0 to stop it.
subroutine analyse_model(n, room, nn, ne, nodes, places, elements, vectors, wishes, stage, index, place, value, by_size, facts)
   use iso_c_binding
   use flexact_result_exchange, only: run
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, room, nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), wishes(6)
   integer(c_int), intent(inout), target :: stage(3)
   integer(c_int), intent(inout) :: index(3, n + 1), place(room)
   real(c_double), intent(inout) :: value(room), by_size(n, 8)
   real(c_double), intent(out) :: facts(48)

   call run(nodes, places, elements, vectors, wishes, stage, index, place, value, by_size, facts)
end subroutine analyse_model

! What small changes of the geometry make of the singular values of pairs of vectors of D(c)
! (flexact_sensitivity). modes: k times the rows of a left vector, then the columns of a right
! one; pair: which two belong together, from 1. effect: lifts by the last bits, the digits typed
! and by storing, largest effects of moving a node and of turning an element; place: that node
! and that element, 0 without one. used: rows and columns of D(c), which n must be.
subroutine find_sensitivities(n, k, pairs, nn, ne, nodes, places, elements, vectors, modes, pair, effect, place, used)
   use iso_c_binding
   use flexact_result_exchange, only: give_sensitivities
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, k, pairs, nn, ne, nodes(5, nn), elements(12, ne), pair(2, pairs)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), modes(n, k)
   real(c_double), intent(out) :: effect(5, pairs)
   integer(c_int), intent(out) :: place(2, pairs), used

   call give_sensitivities(nodes, places, elements, vectors, modes, pair, effect, place, used)
end subroutine find_sensitivities

! Residues of null vectors; wishes and what comes back as give_echelon says. n: columns of
! D(c), or of its transpose; room: no more entries are given.
subroutine find_echelon(n, room, nn, ne, nodes, places, elements, vectors, wishes, pivot, place, facts)
   use iso_c_binding
   use flexact_result_exchange, only: give_echelon
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, room, nn, ne, nodes(5, nn), elements(12, ne), wishes(3)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne)
   integer(c_int), intent(inout) :: pivot(n), place(4, room)
   integer(c_int), intent(out) :: facts(5)

   call give_echelon(nodes, places, elements, vectors, wishes, pivot, place, facts)
end subroutine find_echelon

! Each of some variants of a model; wishes, positions and classes (as many as variants, or
! one for all), and what comes back, as run_variants says.
subroutine analyse_variants(room, variants, nn, ne, np, nc, nodes, places, elements, vectors, wishes, positions, classes, facts)
   use iso_c_binding
   use flexact_variant_exchange, only: run_variants
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: room, variants, nn, ne, np, nc, nodes(5, nn), elements(12, ne), classes(6, ne, nc)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), wishes(11), positions(3, nn, np)
   real(c_double), intent(inout) :: facts(room, variants)

   call run_variants(nodes, places, elements, vectors, wishes, positions, classes, facts)
end subroutine analyse_variants

! S of every element, notches applied, and its constant of torsion and elongation [m^2].
subroutine find_stiffness(nn, ne, nodes, places, elements, vectors, of_elements, stiffness, c_t)
   use iso_c_binding
   use flexact_elastic_exchange, only: give_stiffness
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), of_elements(17, ne)
   real(c_double), intent(out) :: stiffness(6, 6, ne), c_t(ne)

   call give_stiffness(nodes, places, elements, vectors, of_elements, stiffness, c_t)
end subroutine find_stiffness

! From a state in equilibrium to another; all is as run_path says.
subroutine follow_path(nn, ne, nodes, places, elements, vectors, of_nodes, of_elements, gravity, configuration, reaction, &
                       stress, facts)
   use iso_c_binding
   use flexact_elastic_exchange, only: run_path
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), of_nodes(27, nn), of_elements(35, ne), gravity(3, 2)
   real(c_double), intent(out) :: configuration(4, nn), reaction(3, nn), stress(6, ne), facts(6)

   call run_path(nodes, places, elements, vectors, of_nodes, of_elements, gravity, configuration, reaction, stress, facts)
end subroutine follow_path

! What a state answers to small loads, its modes and its matrices; all is as run_task says.
subroutine study_state(n, k, room, nn, ne, nodes, places, elements, vectors, of_nodes, of_elements, wishes, given, answer, facts)
   use iso_c_binding
   use flexact_elastic_exchange, only: run_task
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, k, room, nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), of_nodes(13, nn), of_elements(23, ne), wishes(5), given(n, k)
   real(c_double), intent(inout) :: answer(n, room)
   real(c_double), intent(out) :: facts(5)

   call run_task(nodes, places, elements, vectors, of_nodes, of_elements, wishes, given(:n - 1, :), answer(:n - 1, :), &
                 answer(n, :), facts)
end subroutine study_state
