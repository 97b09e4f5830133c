function results = spacarlight(varargin)
% SPACARLIGHT  A script for SPACAR Light, answered by Flexact.
%
%   results = spacarlight(nodes, elements, nprops, eprops)
%   results = spacarlight(nodes, elements, nprops, eprops, opt)
%   results = spacarlight(nodes, elements, nprops, eprops, rls)         versions before 1.0
%   results = spacarlight(nodes, elements, nprops, eprops, rls, opt)    likewise
%   results = spacarlight(input)    a structure with nodes (or coordinates), elements (or
%                                   connect), nprops, eprops, and perhaps rls and opt
%
% Put first on the path, in place of the function of SPACAR Light, it says of the mechanism of a
% script as it is whether it is exactly constrained, what over-constraint costs, and shows it in
% motion. With an output it returns what scripts read, along the load steps:
%
%   results.step(i)             .freq, .buck (with opt.calcbuck), .stressmax, .lin (with
%                               transfer_in and transfer_out), .node(j), .element(k)
%   results.step(i).node(j)     .p, .r_quat, .r_axang, .r_eulzyx, .Freac, .Mreac, .CMglob, .CMloc
%   results.step(i).element(k)  .e, and .stressmax with opt.stressperelement
%   results.node(j), .freq, .buck, .stressmax    the same for all load steps
%   results.statespace          with opt.transfer
%   results.ndof, results.overconstraints
%   results.verdict, results.under_constrained, results.over_constrained
%
% What is not computed is an error in words where the script reads it. It writes FILENAME.flexact.dat
% and FILENAME.flexact.html beside the script's own files (opt.filename); with opt.silent nothing is
% said and no page is made, with opt.spavisual = false no browser is opened.
%
% It calls the command flexact: that of the environment variable FLEXACT, such as
% 'python3 -m flexact', else the one that is found. It works in MATLAB from R2016b and in Octave
% from 7. Documentation: docs/for_spacar_light_users.md of Flexact.

% SPDX-License-Identifier: BSD-3-Clause

persistent shown
if ~iscell(shown)
    shown = {};
end
[tables, is_old] = arguments_of(varargin);
if isempty(tables)
    warning('spacarlight:incomplete', ['Incomplete input: a verdict is of nodes, elements, ' ...
        'nprops and eprops.']);
    results = struct();
    return
end
opt = tables.opt;
is_silent = is_on(opt, 'silent');
name = 'spacar_file';
if isfield(opt, 'filename') && ischar(opt.filename) && ~isempty(opt.filename)
    name = opt.filename;
end
wants_results = nargout > 0 && ~is_on(opt, 'showinputonly');
if wants_results && ~exist('jsondecode') %#ok<EXIST>
    error('spacarlight:tooOld', 'Results need jsondecode: MATLAB R2016b or Octave 7, or later.');
end

work = tempname();
mkdir(work);
tidy = onCleanup(@() remove(work));
[folder, stem, ending] = fileparts(name);
stem = [stem ending];
input = fullfile(work, [stem '.json']);
output = fullfile(work, [stem '.results.json']);
write(input, json_of_tables(tables));
command = [flexact() ' spacarlight ' quoted(input)];
if wants_results
    command = [command ' -o ' quoted(output)];
end
if ~is_silent
    if isempty(folder) && ~is_writable(pwd())
        folder = tempdir();
    end
    page = fullfile(folder, [stem '.flexact.html']);
    deck = fullfile(folder, [stem '.flexact.dat']);
    command = [command ' --page ' quoted(page) ' --deck ' quoted(deck)];
    key = fullfile(pwd(), page);
    % Of a script that runs in a loop one page is opened.
    if any(strcmp(key, shown)) || is_off(opt, 'spavisual') || in_batch()
        command = [command ' --no-browser'];
    else
        shown{end + 1} = key;
    end
end
[status, said] = called(command);
% MATLAB counts in round brackets.
said = regexprep(said, '(nodes|elements|nprops|eprops|rls)\[(\d+)\]', '$1($2)');
if status ~= 0
    why = regexp(said, 'flexact: error: (.*)$', 'tokens', 'once');
    if ~isempty(why) && ~is_silent
        fprintf('%s', said(1:regexp(said, 'flexact: error: ', 'once') - 1));
    end
    places = regexp(said, '^error\[[^\]]+\]: ([^\n\r]+)', 'tokens', 'lineanchors');
    if ~isempty(why)
        said = why{1};
    elseif ~isempty(places)
        said = strjoin([places{:}], sprintf('\n'));
    end
    error('spacarlight:flexact', '%s', strtrim(said));
end
if ~is_silent
    fprintf('%s', said);
end
results = struct();
if wants_results
    results = results_of(jsondecode(fileread(output)), tables, is_old);
end
end


function [tables, is_old] = arguments_of(given)
% The tables of the arguments, in any of their forms; empty where some are missing.
tables = [];
is_old = false;
if isempty(given)
    error('spacarlight:input', 'No input was provided.');
elseif numel(given) > 6
    error('spacarlight:input', 'Expecting a maximum of 6 input arguments.');
end
if numel(given) == 1 && (isstruct(given{1}) || isobject(given{1}))
    tables = given{1};
    if isobject(tables)
        tables = as_struct(tables);
    end
    older = {'coordinates', 'connect'};
    newer = {'nodes', 'elements'};
    for k = 1:2
        if isfield(tables, older{k})
            tables.(newer{k}) = tables.(older{k});
            tables = rmfield(tables, older{k});
        end
    end
elseif numel(given) >= 4
    tables = struct();
    names = {'nodes', 'elements', 'nprops', 'eprops'};
    for k = 1:4
        tables.(names{k}) = given{k};
    end
    rest = given(5:end);
    if numel(rest) == 2
        tables.rls = rest{1};
        tables.opt = rest{2};
        is_old = true;
    elseif numel(rest) == 1 && isfield(rest{1}, 'def')
        tables.rls = rest{1};
        is_old = true;
    elseif numel(rest) == 1
        tables.opt = rest{1};
    end
end
if isempty(tables)
    return
end
if ~isfield(tables, 'opt') || isempty(tables.opt)
    tables.opt = struct();
end
names = fieldnames(tables);
for k = 1:numel(names)
    if isobject(tables.(names{k}))
        tables.(names{k}) = as_struct(tables.(names{k}));
    end
end
end


function answer = is_on(opt, name)
answer = isfield(opt, name) && ~isempty(opt.(name)) && all(opt.(name)(:) == 1);
end


function answer = is_off(opt, name)
answer = isfield(opt, name) && ~isempty(opt.(name)) && ~any(opt.(name)(:));
end


function answer = is_writable(folder)
[is_known, about] = fileattrib(folder);
answer = ~is_known || ~isequal(about.UserWrite, 0) && ~isequal(about.UserWrite, false);
end


function answer = in_batch()
answer = exist('batchStartupOptionUsed', 'builtin') == 5 && batchStartupOptionUsed();
end


function answer = in_octave()
answer = exist('OCTAVE_VERSION', 'builtin') ~= 0;
end


% The command

function command = flexact()
% The command, which is sought once.
persistent known
if isempty(known)
    own = getenv('FLEXACT');
    candidates = {'flexact', 'python3 -m flexact', 'python -m flexact', 'py -m flexact'};
    if exist(own, 'file') == 2
        candidates = {quoted(own)};
    elseif ~isempty(own)
        candidates = {own};
    end
    found = '';
    for k = 1:numel(candidates)
        [status, said] = called([candidates{k} ' --version']);
        if status == 0 && ~isempty(regexp(said, '^\s*flexact \d', 'once'))
            found = candidates{k};
            break
        end
    end
    if isempty(found)
        error('spacarlight:noFlexact', ['The command flexact is not found (%s): install it with ' ...
            '"pip install flexact", or name it: setenv(''FLEXACT'', ''/path/to/flexact'').'], ...
            strjoin(candidates, ', '));
    end
    known = found;
end
command = known;
end


function [status, said] = called(command)
% The command's exit code, and all that it says.
if ispc()
    % Without a word before it, a name in quotes loses them.
    command = ['call ' command];
elseif ~in_octave()
    % MATLAB's own libraries are none for other programs.
    command = ['env -u LD_LIBRARY_PATH -u DYLD_LIBRARY_PATH ' command];
end
[status, said] = system([command ' 2>&1']);
end


function text = quoted(path)
if ispc()
    text = ['"' path '"'];
else
    text = ['''' strrep(path, '''', '''\''''') ''''];
end
end


function write(path, text)
file = fopen(path, 'w', 'n', 'UTF-8');
if file < 0
    error('spacarlight:file', 'The file %s cannot be written.', path);
end
fwrite(file, unicode2native(text, 'UTF-8'), 'uint8');
fclose(file);
end


function remove(folder)
if exist(folder, 'dir')
    files = dir(fullfile(folder, '*.json'));
    for k = 1:numel(files)
        delete(fullfile(folder, files(k).name));
    end
    rmdir(folder);
end
end


% Tables as JSON, with all digits of numbers, which jsonencode does not keep

function text = json_of_tables(tables)
names = fieldnames(tables);
parts = {};
for k = 1:numel(names)
    name = names{k};
    value = tables.(name);
    if isempty(value)
        continue
    end
    if any(strcmp(name, {'nodes', 'elements'})) && isnumeric(value)
        made = json_of_rows(value, name);
    elseif strcmp(name, 'opt')
        made = json_of(without_handles(value), name);
    else
        made = json_of(value, name);
    end
    parts{end + 1} = ['"' name '": ' made]; %#ok<AGROW>
end
text = sprintf('{\n%s\n}\n', strjoin(parts, sprintf(',\n')));
end


function text = json_of(value, place)
if isobject(value) && ~isa(value, 'string')
    value = as_struct(value);
end
if isa(value, 'string')
    if isscalar(value)
        value = char(value);
    else
        value = cellstr(value);
    end
end
if ischar(value)
    text = json_of_text(value);
elseif islogical(value) && isscalar(value)
    words = {'false', 'true'};
    text = words{value + 1};
elseif (isnumeric(value) || islogical(value)) && isreal(value)
    value = full(double(value));
    if isscalar(value)
        text = json_of_number(value);
    elseif isempty(value) || isvector(value)
        text = ['[' strjoin(arrayfun(@json_of_number, value(:).', 'UniformOutput', false), ', ') ']'];
    else
        text = json_of_rows(value, place);
    end
elseif iscell(value)
    made = cellfun(@(each) json_of(each, place), value(:).', 'UniformOutput', false);
    text = ['[' strjoin(made, ', ') ']'];
elseif isstruct(value) && isscalar(value)
    text = json_of_fields(value, place);
elseif isstruct(value)
    made = cell(1, numel(value));
    for k = 1:numel(value)
        made{k} = ['  ' json_of_fields(value(k), sprintf('%s(%d)', place, k))];
    end
    text = sprintf('[\n%s\n]', strjoin(made, sprintf(',\n')));
else
    error('spacarlight:input', '%s: a %s is no value of a table.', place, class(value));
end
end


function text = json_of_fields(value, place)
names = fieldnames(value);
parts = {};
for k = 1:numel(names)
    if ~isempty(value.(names{k}))
        made = json_of(value.(names{k}), [place '.' names{k}]);
        parts{end + 1} = ['"' names{k} '": ' made]; %#ok<AGROW>
    end
end
text = ['{' strjoin(parts, ', ') '}'];
end


function text = json_of_rows(value, place)
if ndims(value) > 2 || ~isreal(value)
    error('spacarlight:input', '%s: a real matrix is wanted.', place);
end
value = full(double(value));
made = cell(1, size(value, 1));
for k = 1:size(value, 1)
    row = arrayfun(@json_of_number, value(k, :), 'UniformOutput', false);
    made{k} = ['[' strjoin(row, ', ') ']'];
end
text = ['[' strjoin(made, ', ') ']'];
end


function text = json_of_number(value)
if isnan(value)
    text = 'NaN';
elseif isinf(value)
    words = {'-Infinity', 'Infinity'};
    text = words{(value > 0) + 1};
else
    text = sprintf('%.17g', value);
end
end


function text = json_of_text(value)
text = value(:).';
if size(value, 1) > 1
    text = strjoin(cellstr(value).', ' ');
end
text = strrep(strrep(text, '\', '\\'), '"', '\"');
text = regexprep(text, '[\x00-\x1f]', ' ');
text = ['"' text '"'];
end


function made = as_struct(value)
% The public properties of an object, or of several.
names = fieldnames(value);
made = repmat(cell2struct(cell(numel(names), 1), names, 1), size(value));
for k = 1:numel(value)
    for n = 1:numel(names)
        made(k).(names{n}) = value(k).(names{n});
    end
end
end


function opt = without_handles(opt)
% Options with what is for drawing alone, such as a function, left out.
names = fieldnames(opt);
for k = 1:numel(names)
    if isa(opt.(names{k}), 'function_handle')
        opt = rmfield(opt, names{k});
    end
end
end


% Results as SPACAR Light has them

function results = results_of(found, tables, is_old)
require_read(found);
results = rmfield(found, {'step', 'missing'});
steps = as_list(found.step);
every = {'p', 'Freac', 'Mreac', 'r_quat', 'r_eulzyx', 'r_axang'};
for i = 1:numel(steps)
    step = steps{i};
    nodes = as_list(step.node);
    for j = 1:numel(nodes)
        node = nodes{j};
        for k = 1:numel(every)
            if isfield(node, every{k}) && ~isempty(node.(every{k}))
                value = node.(every{k})(:);
                results.node(j).(every{k})(1:numel(value), i) = value;
                % Angles stand in columns there.
                if k <= 4
                    value = value.';
                end
                node.(every{k}) = value;
            end
        end
        for name = {'CMglob', 'CMloc'}
            if isfield(node, name{1}) && ~isempty(node.(name{1}))
                many = size(node.(name{1}), 1);
                results.node(j).(name{1})(1:many, 1:many, i) = node.(name{1});
            end
        end
        if is_old
            node = with_old_names(node);
        end
        nodes{j} = node;
    end
    step.node = [nodes{:}];
    elements = as_list(step.element);
    beams = numbers_of_beams(tables, numel(elements));
    for j = 1:numel(elements)
        elements{j}.e = reshape(elements{j}.e, numel(beams{j}), []);
    end
    step.element = [elements{:}];
    for name = {'freq', 'buck'}
        if isfield(step, name{1})
            step.(name{1}) = step.(name{1})(:);
            results.(name{1})(1:numel(step.(name{1})), i) = step.(name{1});
        end
    end
    if isfield(step, 'stressmax')
        results.stressmax(i) = step.stressmax;
    end
    if isfield(step, 'lin')
        step.lin = system_of(step.lin);
    end
    results.step(i) = step;
end
if isfield(found, 'statespace')
    results.statespace = results.step(end).lin;
end
for j = 1:size(tables.nodes, 1)
    results.node(j).spa_nrs = 3 * (j - 1) + [1 2];
end
for j = 1:numel(beams)
    ends = tables.nodes(tables.elements(j, :), :);
    many = numel(beams{j});
    results.element(j).spa_nrs = beams{j};
    results.element(j).L0 = norm(ends(2, :) - ends(1, :)) / many * ones(1, many);
end
end


function list = as_list(found)
% A cell with each of what jsondecode has made an array, a cell, or a single structure.
if iscell(found)
    list = found(:).';
elseif ischar(found)
    list = {found};
else
    list = num2cell(found(:).');
end
end


function beams = numbers_of_beams(tables, count)
% The beams of each element in the deck.
many = ones(1, count);
for k = 1:numel(tables.eprops)
    set = tables.eprops(k);
    for names = {'nbeams', 'n_beams'; 'elems', 'El_Nrs'}
        if isfield(set, names{1}) && isfield(set, names{2}) && ~isempty(set.(names{1}))
            many(set.(names{2})) = set.(names{1});
        end
    end
end
last = cumsum(many);
beams = cell(1, count);
for j = 1:count
    beams{j} = last(j) - many(j) + (1:many(j));
end
end


function node = with_old_names(node)
% As versions before 0.7 called them.
older = {'x', 'rx_eulzyx', 'rx_axang', 'rx_quat'};
newer = {'p', 'r_eulzyx', 'r_axang', 'r_quat'};
for k = 1:4
    if isfield(node, newer{k})
        node.(older{k}) = node.(newer{k});
    end
end
end


function made = system_of(found)
% A system of the Control System Toolbox, or of Octave's control package, where it is there.
made = found;
% What is a single row or column, or has no states, has lost its shape.
inputs = numel(as_list(found.InputName));
outputs = numel(as_list(found.OutputName));
order = size(found.A, 1);
if order == 0
    found.A = [];
    found.B = [];
    found.C = [];
end
made.A = reshape(found.A, order, order);
made.B = reshape(found.B, order, inputs);
made.C = reshape(found.C, outputs, order);
made.D = reshape(found.D, outputs, inputs);
names = {'InputName', 'OutputName'};
for k = 1:2
    made.(names{k}) = as_list(found.(names{k}));
end
if exist('ss', 'file')
    found = made;
    try
        made = ss(made.A, made.B, made.C, made.D);
        made.InputName = found.InputName;
        made.OutputName = found.OutputName;
    catch
        made = found;
    end
end
end


function require_read(found)
% An error in words where the script reads what is not there; nothing is left empty.
why = struct( ...
    'fighandle', 'Flexact shows the mechanism on a page, not in a figure', ...
    'freqmodes', 'modes are shown on the page, and are those of flexact.elastic in Python', ...
    'bode_data', 'give transfer_in, transfer_out and opt.transfer, and read statespace', ...
    'Ri', 'initial rotations of elements are not computed');
if ~isfield(found, 'statespace') && ~isfield(found.missing, 'lin')
    why.statespace = 'set opt.transfer = {true}, with transfer_in and transfer_out of nodes';
end
if isfield(found.missing, 'lin')
    why.statespace = found.missing.lin;
end
names = fieldnames(found.missing);
for k = 1:numel(names)
    why.(names{k}) = found.missing.(names{k});
end
stack = dbstack('-completenames');
names = fieldnames(why);
own = [mfilename('fullpath') '.m'];
for level = 1:numel(stack)
    path = stack(level).file;
    if strcmp(path, own) || exist(path, 'file') ~= 2
        continue
    end
    % Without texts, in which a percent sign is no comment.
    lines = regexp(regexprep(fileread(path), '''[^''\r\n]*''', ''), '\r?\n', 'split');
    for k = 1:numel(names)
        reads = regexp(lines, ['^[^%]*\.' names{k} '\>'], 'once');
        line = find(~cellfun(@isempty, reads), 1);
        if ~isempty(line)
            error('spacarlight:notReturned', '%s, line %d, reads .%s: %s.', path, line, ...
                names{k}, why.(names{k}));
        end
    end
end
end
