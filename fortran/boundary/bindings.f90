! What Python can call: flat procedures, C types, explicit shapes, no state.
!
! f2py reads this file alone. Kinds are spelt c_int, c_double, c_signed_char
! because f2py turns other named kinds into single precision without a word.
! "threadsafe" lets f2py drop the interpreter lock: a call is a function of its
! arguments.

! How many rows the element table has.
subroutine count_element_kinds(kinds)
   use iso_c_binding
   use flexact_element_table, only: element_kinds
   implicit none
   integer(c_int), intent(out) :: kinds
   kinds = size(element_kinds)
end subroutine count_element_kinds

! One row of the element table.
subroutine describe_element_kind(kind, keyword, slot_kind, deformations, vector, needs_length, dual)
   use iso_c_binding
   use flexact_element_table, only: element_kinds
   use flexact_exchange, only: from_text
   implicit none
   integer(c_int), intent(in) :: kind
   integer(c_signed_char), intent(out) :: keyword(8)
   integer(c_int), intent(out) :: slot_kind(4)
   integer(c_int), intent(out) :: deformations
   integer(c_int), intent(out) :: vector
   integer(c_int), intent(out) :: needs_length
   integer(c_int), intent(out) :: dual(6)

   associate (row => element_kinds(kind))
      call from_text(row%keyword, keyword)
      slot_kind = row%slot_kind
      deformations = row%deformations
      vector = row%vector
      needs_length = merge(1, 0, row%needs_length)
      dual = row%dual
   end associate
end subroutine describe_element_kind

! How large the arrays of a deck's model must be: an upper bound.
subroutine survey_deck(n, text, elements, node_slots)
   use iso_c_binding
   implicit none
   integer(c_int), intent(in) :: n
   integer(c_signed_char), intent(in) :: text(n)
   integer(c_int), intent(out) :: elements
   integer(c_int), intent(out) :: node_slots

   elements = count(text == 10_c_signed_char) + 1
   node_slots = int(min(4*int(elements, c_int64_t), int(n, c_int64_t)/2 + 4), c_int)
end subroutine survey_deck

! Read a deck. sizes: nodes, elements, 1 for a planar scene, statements that
! were read and not used, 1 where the deck says how elements are drawn; only then
! look_choice and look_value are filled. Diagnostics and these as flexact_exchange
! gives them.
subroutine read_deck(n, text, most_nodes, most_elements, node_number, node_kind, node_value, coordinate_class, &
                     element_number, element_kind, element_node, element_vector, deformation_class, &
                     element_origin, element_name, look_choice, look_value, sizes, diag_count, diag_number, diag_text)
   use iso_c_binding
   use flexact_deck, only: read_text => read_deck
   use flexact_deck_scene, only: scene_t
   use flexact_diagnostics, only: diagnostics_t
   use flexact_exchange, only: to_text, give_diagnostics, give_look
   use flexact_model, only: node_position, node_orientation
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: n
   integer(c_signed_char), intent(in) :: text(n)
   integer(c_int), intent(in) :: most_nodes
   integer(c_int), intent(in) :: most_elements
   integer(c_int), intent(inout) :: node_number(most_nodes)
   integer(c_int), intent(inout) :: node_kind(most_nodes)
   real(c_double), intent(inout) :: node_value(4, most_nodes)
   integer(c_int), intent(inout) :: coordinate_class(3, most_nodes)
   integer(c_int), intent(inout) :: element_number(most_elements)
   integer(c_int), intent(inout) :: element_kind(most_elements)
   integer(c_int), intent(inout) :: element_node(4, most_elements)
   real(c_double), intent(inout) :: element_vector(3, most_elements)
   integer(c_int), intent(inout) :: deformation_class(6, most_elements)
   integer(c_int), intent(inout) :: element_origin(most_elements)
   integer(c_int), intent(inout) :: element_name(2, most_elements)
   integer(c_int), intent(inout) :: look_choice(2, most_elements)
   real(c_double), intent(inout) :: look_value(9, most_elements)
   integer(c_int), intent(out) :: sizes(8)
   integer(c_int), intent(out) :: diag_count(4)
   integer(c_int), intent(out) :: diag_number(8, 100)
   integer(c_signed_char), intent(out) :: diag_text(240, 4, 100)
   character(len=:), allocatable :: letters
   type(scene_t) :: scene
   type(diagnostics_t) :: diagnostics
   integer :: unused

   call to_text(text, letters)
   call read_text(letters, scene, unused, diagnostics)
   call give_diagnostics(letters, diagnostics, diag_count, diag_number, diag_text)
   sizes = 0
   sizes(4) = unused
   if (diagnostics%has_errors()) return
   associate (model => scene%model, nn => scene%model%nodes, ne => scene%model%elements)
      sizes(1) = nn
      sizes(2) = ne
      sizes(3) = merge(0, 1, any(model%node_kind == node_position .or. model%node_kind == node_orientation))
      node_number(:nn) = model%node_number
      node_kind(:nn) = model%node_kind
      node_value(:, :nn) = model%node_value
      coordinate_class(:, :nn) = model%coordinate_class
      element_number(:ne) = model%element_number
      element_kind(:ne) = model%element_kind
      element_node(:, :ne) = model%element_node
      element_vector(:, :ne) = model%element_vector
      deformation_class(:, :ne) = model%deformation_class
      element_origin(:ne) = model%element_origin
      element_name(1, :ne) = scene%element_names%first
      element_name(2, :ne) = scene%element_names%last
      sizes(5) = merge(1, 0, allocated(scene%look))
      if (allocated(scene%look)) call give_look(scene%look, look_choice(:, :ne), look_value(:, :ne))
   end associate
end subroutine read_deck

! Check a model that was made without a deck.
subroutine check_model(nn, ne, node_number, node_kind, node_value, coordinate_class, &
                       element_number, element_kind, element_node, element_vector, deformation_class, &
                       diag_count, diag_number, diag_text)
   use iso_c_binding
   use flexact_checks, only: check => check_model, is_consistent
   use flexact_diagnostics, only: diagnostics_t, span_t
   use flexact_exchange, only: make_model, give_diagnostics
   use flexact_model, only: model_t
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: nn
   integer(c_int), intent(in) :: ne
   integer(c_int), intent(in) :: node_number(nn)
   integer(c_int), intent(in) :: node_kind(nn)
   real(c_double), intent(in) :: node_value(4, nn)
   integer(c_int), intent(in) :: coordinate_class(3, nn)
   integer(c_int), intent(in) :: element_number(ne)
   integer(c_int), intent(in) :: element_kind(ne)
   integer(c_int), intent(in) :: element_node(4, ne)
   real(c_double), intent(in) :: element_vector(3, ne)
   integer(c_int), intent(in) :: deformation_class(6, ne)
   integer(c_int), intent(out) :: diag_count(4)
   integer(c_int), intent(out) :: diag_number(8, 100)
   integer(c_signed_char), intent(out) :: diag_text(240, 4, 100)
   type(model_t) :: model
   type(diagnostics_t) :: diagnostics

   call make_model(node_number, node_kind, node_value, coordinate_class, element_number, element_kind, &
                   element_node, element_vector, deformation_class, model)
   if (is_consistent(model)) then
      call check(model, diagnostics)
   else
      call diagnostics%error('inconsistent-model', span_t(), 'the arrays of the model do not fit together', '', &
                             'give every element nodes of the kinds that it joins')
   end if
   call give_diagnostics('', diagnostics, diag_count, diag_number, diag_text)
end subroutine check_model

! Counts (coordinates, deformations; total, fixed, dependent, independent), the
! size of D(c), and an upper bound of the entries of the whole Jacobian.
subroutine count_model(nn, ne, node_kind, coordinate_class, element_kind, deformation_class, &
                       counts, rows, columns, entries)
   use iso_c_binding
   use flexact_model, only: model_t
   use flexact_partition, only: count => count_model, model_count_t
   implicit none
   integer(c_int), intent(in) :: nn
   integer(c_int), intent(in) :: ne
   integer(c_int), intent(in) :: node_kind(nn)
   integer(c_int), intent(in) :: coordinate_class(3, nn)
   integer(c_int), intent(in) :: element_kind(ne)
   integer(c_int), intent(in) :: deformation_class(6, ne)
   integer(c_int), intent(out) :: counts(2, 4)
   integer(c_int), intent(out) :: rows
   integer(c_int), intent(out) :: columns
   integer(c_int), intent(out) :: entries
   type(model_t) :: model
   type(model_count_t) :: total

   allocate (model%node_kind(nn), source=node_kind)
   allocate (model%coordinate_class(3, nn), source=coordinate_class)
   allocate (model%element_kind(ne), source=element_kind)
   allocate (model%deformation_class(6, ne), source=deformation_class)
   call count(model, total)
   associate (x => total%coordinates, e => total%deformations)
      counts(1, :) = [x%total, x%fixed, x%dependent, x%independent]
      counts(2, :) = [e%total, e%fixed, e%dependent, e%independent]
   end associate
   rows = total%rows
   columns = total%columns
   entries = total%entries
end subroutine count_model

! Deformations and the whole Jacobian in a configuration. Rows and columns are
! counted from 0: 6*element + deformation, 3*node + axis.
subroutine assemble(entries, nn, ne, node_number, node_kind, node_value, coordinate_class, &
                    element_number, element_kind, element_node, element_vector, deformation_class, &
                    configuration, c_t, deformation, row_of, column_of, value, used, status)
   use iso_c_binding
   use flexact_exchange, only: make_model
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_model, only: model_t
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: entries
   integer(c_int), intent(in) :: nn
   integer(c_int), intent(in) :: ne
   integer(c_int), intent(in) :: node_number(nn)
   integer(c_int), intent(in) :: node_kind(nn)
   real(c_double), intent(in) :: node_value(4, nn)
   integer(c_int), intent(in) :: coordinate_class(3, nn)
   integer(c_int), intent(in) :: element_number(ne)
   integer(c_int), intent(in) :: element_kind(ne)
   integer(c_int), intent(in) :: element_node(4, ne)
   real(c_double), intent(in) :: element_vector(3, ne)
   integer(c_int), intent(in) :: deformation_class(6, ne)
   real(c_double), intent(in) :: configuration(4, nn)
   real(c_double), intent(in) :: c_t(ne)
   real(c_double), intent(out) :: deformation(6, ne)
   integer(c_int), intent(out) :: row_of(entries)
   integer(c_int), intent(out) :: column_of(entries)
   real(c_double), intent(out) :: value(entries)
   integer(c_int), intent(out) :: used
   integer(c_int), intent(out) :: status
   type(model_t) :: model
   type(jacobian_t) :: jacobian

   call make_model(node_number, node_kind, node_value, coordinate_class, element_number, element_kind, &
                   element_node, element_vector, deformation_class, model)
   call make_jacobian(model, configuration, jacobian, c_t)
   used = jacobian%entries
   status = merge(0, 1, used <= entries)
   if (status /= 0) used = 0
   deformation = jacobian%deformation
   row_of = 0
   column_of = 0
   value = 0
   row_of(:used) = 6*(jacobian%row(1, :used) - 1) + jacobian%row(2, :used) - 1
   column_of(:used) = 3*(jacobian%column(1, :used) - 1) + jacobian%column(2, :used) - 1
   value(:used) = jacobian%value(:used)
end subroutine assemble

! Rank, motions and self-stresses in the reference configuration. wishes:
! tolerance (negative: from the data), bytes of memory that may be used, 1 if
! only the smallest singular values of D(c) itself are wanted.
! Indices count from 0. A basis that does not fit its room is given in part.
! numbers: tolerance, characteristic length, noise, bytes needed, reach of digits. facts: rank,
! method, 1 if confirmed, singular values of D(c) and scaled values given, pairs,
! motions, self-stresses, parts, rows and columns of the largest. stage: what is
! at work and per cent, kept up to date. status: as in flexact_answer, or 3 for
! sizes that are not the model's.
subroutine analyse_model(rows, columns, least, pairs, motion_room, stress_room, nn, ne, method, wishes, &
                         node_number, node_kind, node_value, coordinate_class, &
                         element_number, element_kind, element_node, element_vector, deformation_class, &
                         stage, motion_start, motion_place, motion_value, stress_start, stress_place, stress_value, &
                         row_label, column_label, length, singular_values, scaled_values, row_scale, column_scale, &
                         pair_value, pair_motion, pair_stress, numbers, facts, status)
   use iso_c_binding
   use flexact_answer, only: answer_t, options_t
   use flexact_determinacy, only: analyse
   use flexact_exchange, only: make_model, give_basis
   use flexact_model, only: model_t
   use flexact_partition, only: model_count_t, count_model_again => count_model
   use flexact_parts, only: largest_part
   use flexact_problem, only: problem_t
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: rows
   integer(c_int), intent(in) :: columns
   integer(c_int), intent(in) :: least
   integer(c_int), intent(in) :: pairs
   integer(c_int), intent(in) :: motion_room
   integer(c_int), intent(in) :: stress_room
   integer(c_int), intent(in) :: nn
   integer(c_int), intent(in) :: ne
   integer(c_int), intent(in) :: method
   real(c_double), intent(in) :: wishes(3)
   integer(c_int), intent(in) :: node_number(nn)
   integer(c_int), intent(in) :: node_kind(nn)
   real(c_double), intent(in) :: node_value(4, nn)
   integer(c_int), intent(in) :: coordinate_class(3, nn)
   integer(c_int), intent(in) :: element_number(ne)
   integer(c_int), intent(in) :: element_kind(ne)
   integer(c_int), intent(in) :: element_node(4, ne)
   real(c_double), intent(in) :: element_vector(3, ne)
   integer(c_int), intent(in) :: deformation_class(6, ne)
   integer(c_int), intent(inout), target :: stage(2)
   integer(c_int), intent(inout) :: motion_start(columns + 1)
   integer(c_int), intent(inout) :: motion_place(motion_room)
   real(c_double), intent(inout) :: motion_value(motion_room)
   integer(c_int), intent(inout) :: stress_start(rows + 1)
   integer(c_int), intent(inout) :: stress_place(stress_room)
   real(c_double), intent(inout) :: stress_value(stress_room)
   integer(c_int), intent(out) :: row_label(2, rows)
   integer(c_int), intent(out) :: column_label(2, columns)
   real(c_double), intent(out) :: length(ne)
   real(c_double), intent(out) :: singular_values(least)
   real(c_double), intent(out) :: scaled_values(least)
   real(c_double), intent(out) :: row_scale(rows)
   real(c_double), intent(out) :: column_scale(columns)
   real(c_double), intent(out) :: pair_value(pairs)
   real(c_double), intent(out) :: pair_motion(columns, pairs)
   real(c_double), intent(out) :: pair_stress(rows, pairs)
   real(c_double), intent(out) :: numbers(5)
   integer(c_int), intent(out) :: facts(12)
   integer(c_int), intent(out) :: status
   type(model_t) :: model
   type(options_t) :: options
   type(problem_t) :: problem
   type(answer_t) :: answer
   type(model_count_t) :: counts
   integer :: given

   numbers = 0
   facts = 0
   status = 3
   call make_model(node_number, node_kind, node_value, coordinate_class, element_number, element_kind, &
                   element_node, element_vector, deformation_class, model)
   call count_model_again(model, counts)
   if (counts%rows /= rows .or. counts%columns /= columns .or. least /= min(rows, columns)) return
   options%method = method
   if (wishes(1) >= 0) options%tolerance = wishes(1)
   options%memory = wishes(2)
   options%only_plain_values = wishes(3) > 0
   options%stage => stage
   call analyse(model, options, problem, answer)
   status = answer%status
   numbers(4) = answer%bytes
   if (status /= 0) return
   row_label = problem%partition%row_label
   column_label = problem%partition%column_label
   length = problem%length
   row_scale = problem%scaling%row
   column_scale = problem%scaling%column
   facts(4) = size(answer%singular_values)
   facts(5) = size(answer%scaled_values)
   singular_values(:facts(4)) = answer%singular_values
   scaled_values(:facts(5)) = answer%scaled_values
   given = min(pairs, size(answer%pair_value))
   pair_value(:given) = answer%pair_value(:given)
   pair_motion(:, :given) = answer%pair_motion(:, :given)
   pair_stress(:, :given) = answer%pair_stress(:, :given)
   facts(6) = given
   call give_basis(answer%motions, motion_start, motion_place, motion_value, facts(7))
   call give_basis(answer%stresses, stress_start, stress_place, stress_value, facts(8))
   facts(1) = answer%decision%rank
   facts(2) = answer%method
   facts(3) = merge(1, 0, answer%confirmed)
   facts(9) = problem%parts%count
   facts(10:11) = largest_part(problem%parts)
   numbers(:3) = [answer%decision%tolerance, problem%scaling%characteristic_length, answer%decision%noise]
   numbers(5) = problem%scaling%reach_of_digits
end subroutine analyse_model

! What small changes of the geometry make of the singular values of pairs of
! vectors of D(c) (flexact_sensitivity). numbers: lifts by the last bits and by
! the digits typed, largest effects of moving a node and of turning an element;
! place: that node and that element, 0 without one. status: 0, or 3 for sizes
! that are not the model's.
subroutine find_sensitivities(rows, columns, a, b, pairs, nn, ne, node_number, node_kind, node_value, coordinate_class, &
                              element_number, element_kind, element_node, element_vector, deformation_class, &
                              u, v, pair, numbers, place, status)
   use iso_c_binding
   use flexact_exchange, only: make_model
   use flexact_model, only: model_t
   use flexact_partition, only: model_count_t, count_model_again => count_model
   use flexact_sensitivity, only: sensitivity_t, find => find_sensitivities
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: rows
   integer(c_int), intent(in) :: columns
   integer(c_int), intent(in) :: a
   integer(c_int), intent(in) :: b
   integer(c_int), intent(in) :: pairs
   integer(c_int), intent(in) :: nn
   integer(c_int), intent(in) :: ne
   integer(c_int), intent(in) :: node_number(nn)
   integer(c_int), intent(in) :: node_kind(nn)
   real(c_double), intent(in) :: node_value(4, nn)
   integer(c_int), intent(in) :: coordinate_class(3, nn)
   integer(c_int), intent(in) :: element_number(ne)
   integer(c_int), intent(in) :: element_kind(ne)
   integer(c_int), intent(in) :: element_node(4, ne)
   real(c_double), intent(in) :: element_vector(3, ne)
   integer(c_int), intent(in) :: deformation_class(6, ne)
   real(c_double), intent(in) :: u(rows, a)
   real(c_double), intent(in) :: v(columns, b)
   integer(c_int), intent(in) :: pair(2, pairs)
   real(c_double), intent(out) :: numbers(4, pairs)
   integer(c_int), intent(out) :: place(2, pairs)
   integer(c_int), intent(out) :: status
   type(model_t) :: model
   type(model_count_t) :: counts
   type(sensitivity_t) :: found(pairs)
   integer :: i

   numbers = 0
   place = 0
   status = 3
   call make_model(node_number, node_kind, node_value, coordinate_class, element_number, element_kind, &
                   element_node, element_vector, deformation_class, model)
   call count_model_again(model, counts)
   if (counts%rows /= rows .or. counts%columns /= columns) return
   if (any(pair < 1) .or. any(pair(1, :) > a) .or. any(pair(2, :) > b)) return
   status = 0
   call find(model, u, v, pair, found)
   do i = 1, pairs
      numbers(:, i) = [found(i)%lift_of_bits, found(i)%lift_of_digits, found(i)%by_move, found(i)%by_turn]
      place(:, i) = [found(i)%node, found(i)%element]
   end do
end subroutine find_sensitivities
