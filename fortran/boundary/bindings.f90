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
! it says how elements are drawn, what they are made of, and loads, of which the other arrays are;
! length_power is the power of ten of the unit of its lengths in metres: all numbers here are in SI.
subroutine read_deck(n, text, most_nodes, most_elements, valued_nodes, valued_elements, nodes, places, elements, vectors, &
                     element_name, node_name, cross_section, drawn, dimensions, colour, edge_colour, opacity, &
                     stiffness, mass, strength, expansion, fillet, node_mass, force, increment, node_count, element_count, &
                     is_planar, has_long_numbers, has_appearance, has_properties, has_loads, length_power, gravity, &
                     diag_count, diag_number, diag_text)
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
   real(c_double), intent(inout) :: strength(2, valued_elements), expansion(1, valued_elements), fillet(1, valued_elements)
   real(c_double), intent(inout) :: force(3, valued_nodes), increment(3, valued_nodes)
   integer(c_int), intent(out) :: node_count, element_count, is_planar, has_long_numbers
   integer(c_int), intent(out) :: has_appearance, has_properties, has_loads, length_power
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
   length_power = 0
   gravity = 0
   if (diagnostics%has_errors()) return
   call give_sizes(deck, node_count, element_count, is_planar, has_long_numbers, has_appearance, has_properties, has_loads)
   length_power = deck%length_power
   if (node_count <= most_nodes .and. element_count <= most_elements) &
      call give_model(deck, nodes, places, elements, vectors, element_name, node_name)
   if (node_count > valued_nodes .or. element_count > valued_elements) return
   call give_appearance(deck, cross_section, drawn, dimensions, colour, edge_colour, opacity)
   call give_properties(deck, stiffness, mass, strength, expansion, fillet, node_mass)
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

! Rank, motions and self-stresses in the reference configuration. n: rows and columns of D(c), at
! least 1. method, prove: as flexact_names has them; tolerance: negative for that of the data;
! memory: bytes that may be used; only_plain_values: 1 if only the singular values of D(c) itself
! are wanted (by sparse the smallest), which come as scaled_value then; as_stored: 1 if numbers
! are no decimals. stage: work, per cent, not 0 to stop it. label: owner and part of each row of
! D(c), then of each column, from 1. Of motions, then of self-stresses, vector k begins at
! first(k) of place (from 0) and value. scale: of each row, then of each column; scaled_value:
! singular values; pair_vector: of each pair the left vector, then the right one. facts: as
! flexact_names has them; pair_value: singular values of pairs.
subroutine analyse_model(n, room, nn, ne, nodes, places, elements, vectors, method, tolerance, memory, only_plain_values, prove, &
                         as_stored, stage, label, first, place, value, scale, scaled_value, pair_vector, facts, pair_value)
   use iso_c_binding
   use flexact_result_exchange, only: run
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, room, nn, ne, nodes(5, nn), elements(12, ne), method, only_plain_values, prove, as_stored
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), tolerance, memory
   integer(c_int), intent(inout), target :: stage(3)
   integer(c_int), intent(inout) :: label(2, n), first(n + 1), place(room)
   real(c_double), intent(inout) :: value(room), scale(n), scaled_value(n), pair_vector(n, 6)
   real(c_double), intent(out) :: facts(37), pair_value(6)

   call run(nodes, places, elements, vectors, method, tolerance, memory, only_plain_values > 0, prove, as_stored > 0, stage, &
            label, first, place, value, scale, scaled_value, pair_vector, facts, pair_value)
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

! The reduced echelon form of D(c), or of its transpose, modulo a prime. n: its columns; number:
! of the prime; as_stored: 1 if numbers are no decimals. pivot: of each column 1 where some row
! begins. entry: of each other one that is not zero the column, the one where its row begins, and
! the residue in two parts of 31 bits. prime: in two parts likewise; as_typed: 1 if of decimals;
! used: entries, of which as many as fit are given.
subroutine find_echelon(n, room, nn, ne, nodes, places, elements, vectors, number, as_stored, is_transposed, pivot, entry, &
                        prime, as_typed, used)
   use iso_c_binding
   use flexact_result_exchange, only: give_echelon
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n, room, nn, ne, nodes(5, nn), elements(12, ne), number, as_stored, is_transposed
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne)
   integer(c_int), intent(inout) :: pivot(n), entry(4, room)
   integer(c_int), intent(out) :: prime(2), as_typed, used

   call give_echelon(nodes, places, elements, vectors, number, as_stored > 0, is_transposed > 0, pivot, entry, prime, &
                     as_typed, used)
end subroutine find_echelon

! Each of some variants of a model (flexact_variants). positions, classes: as many as variants, or
! one for all. near to most_reach, with_values, zero_counts and zero_limits: as question_t and
! zero_limits_t have them; memory to as_stored: as for analyse_model. facts: of each variant, as
! flexact_names has them; of each pair its value and what that changes by a move and by a turn.
subroutine analyse_variants(variants, nn, ne, np, nc, nodes, places, elements, vectors, near, cut_off, most_reach, with_values, &
                            memory, prove, as_stored, zero_counts, zero_limits, positions, classes, facts, pair_value, by_move, &
                            by_turn)
   use iso_c_binding
   use flexact_variant_exchange, only: run_variants
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: variants, nn, ne, np, nc, nodes(5, nn), elements(12, ne), classes(6, ne, nc), with_values, prove, &
                                 as_stored, zero_counts(2)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), near, cut_off, most_reach, memory, zero_limits(2), &
                                 positions(3, nn, np)
   real(c_double), intent(out) :: facts(11, variants), pair_value(6, variants), by_move(6, variants), by_turn(6, variants)

   call run_variants(nodes, places, elements, vectors, near, cut_off, most_reach, with_values > 0, memory, prove, as_stored > 0, &
                     zero_counts, zero_limits, positions, classes, facts, pair_value, by_move, by_turn)
end subroutine analyse_variants

! S of every element, notches applied, and its constant of torsion and elongation [m^2].
! stiffness: numbers of ESTIFF; notch: of each deformation, as it is where it is no number, else
! released with a stiffness in series.
subroutine find_stiffness(nn, ne, nodes, places, elements, vectors, stiffness, notch, element_stiffness, c_t)
   use iso_c_binding
   use flexact_elastic_exchange, only: give_stiffness
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), notch(6, ne)
   real(c_double), intent(out) :: element_stiffness(6, 6, ne), c_t(ne)

   call give_stiffness(nodes, places, elements, vectors, stiffness, notch, element_stiffness, c_t)
end subroutine find_stiffness

! From a state in equilibrium under what is given first to that under what is given then. mass and
! node_mass: numbers of EM and XM, no numbers where they are not given; configuration, stress and
! reaction: of the state, which change. target: of held coordinates; misfit: deformations without
! stress. status: as flexact_names has it, -1 where memory does not suffice; reached: part of the
! way; place: of the residual, 3*node + axis, or -1 - (6*element + deformation).
subroutine follow_path(nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                       reaction, target, misfit, force, gravity, status, reached, iterations, steps, residual, place)
   use iso_c_binding
   use flexact_elastic_exchange, only: study_t, begin_study, end_study, give_path
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), mass(5, ne), notch(6, ne), node_mass(6, nn), &
                                 target(4, nn, 2), misfit(6, ne, 2), force(3, nn, 2), gravity(3, 2)
   real(c_double), intent(inout) :: configuration(4, nn), stress(6, ne), reaction(3, nn)
   integer(c_int), intent(out) :: status, iterations, steps, place
   real(c_double), intent(out) :: reached, residual
   type(study_t) :: study

   call begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, study)
   call give_path(study, target, misfit, force, gravity, configuration, stress, reaction, status, reached, iterations, steps, &
                  residual, place)
   call end_study(study)
end subroutine follow_path

! Increments of a state with its tangent K + H(stress) under k loads, misfits and shifts of what
! is held; the state is given as for follow_path. mismatch: what rigid rows could not follow,
! relative to what was asked. loose: motions without stiffness, as many as fit of unheld;
! negative: how many stiffnesses are; failed: 1 where the arithmetic fails or memory does not
! suffice.
subroutine find_response(k, room, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, &
                         stress, reaction, gravity, force, misfit, shift, displacement, stress_change, reaction_change, &
                         mismatch, loose, unheld, negative, failed)
   use iso_c_binding
   use flexact_elastic_exchange, only: study_t, begin_study, end_study, give_response
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: k, room, nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), mass(5, ne), notch(6, ne), node_mass(6, nn), &
                                 configuration(4, nn), stress(6, ne), reaction(3, nn), gravity(3), force(3, nn, k), &
                                 misfit(6, ne, k), shift(3, nn, k)
   real(c_double), intent(out) :: displacement(3, nn, k), stress_change(6, ne, k), reaction_change(3, nn, k), mismatch(k), &
                                  loose(3, nn, room)
   integer(c_int), intent(out) :: unheld, negative, failed
   type(study_t) :: study

   call begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, study)
   call give_response(study, gravity, force, misfit, shift, displacement, stress_change, reaction_change, mismatch, loose, &
                      unheld, negative, failed)
   call end_study(study)
end subroutine find_response

! Values and modes of a state, given as for follow_path: of_buckling 0: squares of the lowest
! frequencies, 1: buckling multipliers nearest to zero. count: at most so many; found: how many
! there are; unheld: motions without stiffness; negative: stiffnesses that are; complete: 1 where
! none is missing between; failed: as for find_response.
subroutine find_modes(count, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                      reaction, gravity, of_buckling, value, mode, found, unheld, negative, complete, failed)
   use iso_c_binding
   use flexact_elastic_exchange, only: study_t, begin_study, end_study, give_modes
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: count, nn, ne, nodes(5, nn), elements(12, ne), of_buckling
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), mass(5, ne), notch(6, ne), node_mass(6, nn), &
                                 configuration(4, nn), stress(6, ne), reaction(3, nn), gravity(3)
   real(c_double), intent(out) :: value(count), mode(3, nn, count)
   integer(c_int), intent(out) :: found, unheld, negative, complete, failed
   type(study_t) :: study

   call begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, study)
   call give_modes(study, gravity, of_buckling > 0, value, mode, found, unheld, negative, complete, failed)
   call end_study(study)
end subroutine find_modes

! Matrices of a state, given as for follow_path, in independent coordinates: 3*node + axis, or
! -1 - (6*element + deformation), each. determined: 1 where these determine all motions.
subroutine find_matrices(q, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                         reaction, gravity, independent, reduced_mass, reduced_stiffness, geometric, determined, failed)
   use iso_c_binding
   use flexact_elastic_exchange, only: study_t, begin_study, end_study, give_matrices
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: q, nn, ne, nodes(5, nn), elements(12, ne), independent(q)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), mass(5, ne), notch(6, ne), node_mass(6, nn), &
                                 configuration(4, nn), stress(6, ne), reaction(3, nn), gravity(3)
   real(c_double), intent(out) :: reduced_mass(q, q), reduced_stiffness(q, q), geometric(q, q)
   integer(c_int), intent(out) :: determined, failed
   type(study_t) :: study

   call begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, study)
   call give_matrices(study, gravity, independent, reduced_mass, reduced_stiffness, geometric, determined, failed)
   call end_study(study)
end subroutine find_matrices

! Errors nearest to zero on both sides at which K - square M + error H(unit_stress) is singular,
! of a state given as for follow_path. square: ns of them; unit_stress, length: of each of k errors. unheld, negative:
! of K - square M; where there are such, none is looked for; failed: as for find_response.
subroutine find_errors(ns, k, nn, ne, nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, &
                       reaction, gravity, square, unit_stress, length, below, above, unheld, negative, failed)
   use iso_c_binding
   use flexact_elastic_exchange, only: study_t, begin_study, end_study, give_errors
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: ns, k, nn, ne, nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne), stiffness(6, ne), mass(5, ne), notch(6, ne), node_mass(6, nn), &
                                 configuration(4, nn), stress(6, ne), reaction(3, nn), gravity(3), square(ns), &
                                 unit_stress(6, ne, k), length(k)
   real(c_double), intent(out) :: below(ns, k), above(ns, k)
   integer(c_int), intent(out) :: unheld, negative, failed
   type(study_t) :: study

   call begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, study)
   call give_errors(study, gravity, square, unit_stress, length, below, above, unheld, negative, failed)
   call end_study(study)
end subroutine find_errors
