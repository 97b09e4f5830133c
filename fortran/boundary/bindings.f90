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
! were read and not used. Diagnostics as flexact_exchange gives them.
subroutine read_deck(n, text, most_nodes, most_elements, node_number, node_kind, node_value, coordinate_class, &
                     element_number, element_kind, element_node, element_vector, deformation_class, &
                     element_origin, element_name, sizes, diag_count, diag_number, diag_text)
   use iso_c_binding
   use flexact_deck, only: read_text => read_deck
   use flexact_deck_scene, only: scene_t
   use flexact_diagnostics, only: diagnostics_t
   use flexact_exchange, only: to_text, give_diagnostics
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

! Rank, motions and self-stresses in the reference configuration. numbers:
! tolerance on scaled_values, characteristic length, noise, 0. status: 0 fine,
! 1 no convergence, 2 not enough memory, 3 sizes that are not the model's.
subroutine analyse_model(rows, columns, least, nn, ne, node_number, node_kind, node_value, coordinate_class, &
                         element_number, element_kind, element_node, element_vector, deformation_class, &
                         motions, stresses, row_label, column_label, length, singular_values, scaled_values, &
                         row_scale, column_scale, numbers, rank, status)
   use iso_c_binding
   use flexact_determinacy, only: determinacy_t, analyse
   use flexact_exchange, only: make_model
   use flexact_model, only: model_t
   use flexact_partition, only: model_count_t, count_model_again => count_model
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: rows
   integer(c_int), intent(in) :: columns
   integer(c_int), intent(in) :: least
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
   real(c_double), intent(inout) :: motions(columns, columns)
   real(c_double), intent(inout) :: stresses(rows, rows)
   integer(c_int), intent(out) :: row_label(2, rows)
   integer(c_int), intent(out) :: column_label(2, columns)
   real(c_double), intent(out) :: length(ne)
   real(c_double), intent(out) :: singular_values(least)
   real(c_double), intent(out) :: scaled_values(least)
   real(c_double), intent(out) :: row_scale(rows)
   real(c_double), intent(out) :: column_scale(columns)
   real(c_double), intent(out) :: numbers(4)
   integer(c_int), intent(out) :: rank
   integer(c_int), intent(out) :: status
   type(model_t) :: model
   type(determinacy_t) :: result
   type(model_count_t) :: counts

   rank = 0
   numbers = 0
   status = 3
   call make_model(node_number, node_kind, node_value, coordinate_class, element_number, element_kind, &
                   element_node, element_vector, deformation_class, model)
   call count_model_again(model, counts)
   if (counts%rows /= rows .or. counts%columns /= columns .or. least /= min(rows, columns)) return
   call analyse(model, motions, stresses, result)
   status = result%status
   if (status /= 0) return
   row_label = result%partition%row_label
   column_label = result%partition%column_label
   length = result%length
   singular_values = result%singular_values
   scaled_values = result%scaled_values
   row_scale = result%scaling%row
   column_scale = result%scaling%column
   numbers(1) = result%decision%tolerance
   numbers(2) = result%scaling%characteristic_length
   numbers(3) = result%decision%noise
   rank = result%decision%rank
end subroutine analyse_model
