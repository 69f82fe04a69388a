#!/usr/bin/perl
# Doxygen's INPUT_FILTER for Markdown: gives headings the anchors that GitHub gives them, and turns
# relative links into references, so that the same text works in both places. Links to files that
# are no page of the site become plain text. Called as markdown_filter.pl FILE, in the repository's root.
use strict;
use warnings;
use Cwd qw(getcwd);
use File::Basename qw(dirname);
use File::Spec;

my $root = getcwd();
my $file = File::Spec->abs2rel(File::Spec->rel2abs($ARGV[0]), $root);
open(my $in, '<', $file) or die "$file: $!\n";
local $/;
my $text = <$in>;
close($in);

# docs/fitting.md -> fitting, samples/effects/README.md -> samples-effects, README.md -> index
sub page_of {
    my ($path) = @_;
    return 'index' if $path eq 'README.md';
    $path =~ s{^docs/(?!README)}{};
    $path =~ s{(/README)?\.md$}{};
    $path =~ s{/}{-}g;
    return lc $path;
}

sub slug {
    my ($heading) = @_;
    $heading =~ s/\[([^\]]*)\]\([^)]*\)/$1/g;
    $heading = lc $heading;
    $heading =~ s/[^\w\- \x80-\xff]//g;
    $heading =~ s/ /-/g;
    return $heading;
}

# A path as written in this file, from the root: without "..", so that it names the page.
sub from_root {
    my ($path) = @_;
    my @parts;
    for my $part (split m{/}, dirname($file) . '/' . $path) {
        next if $part eq '.' || $part eq '';
        if ($part eq '..') { pop @parts } else { push @parts, $part }
    }
    return join '/', @parts;
}

my $page = page_of($file);

sub link_to {
    my ($label, $target) = @_;
    return "[$label]($target)" if $target =~ /^[a-z]+:/;
    my ($path, $anchor) = $target =~ /^([^#]*)(?:#(.*))?$/s;
    # Pages that are HTML already are copied beside the site's own.
    return "[$label](" . (from_root($path) =~ s{^docs/}{}r) . ')' if $path =~ /\.html$/;
    my $to = $path eq '' ? $page : $path =~ /\.md$/ ? page_of(from_root($path)) : undef;
    return $label unless defined $to;
    return "[$label](\@ref " . (defined $anchor ? "$to-$anchor" : $to) . ')';
}

my %met;
my @out;
my $in_fence = 0;
my $is_first_heading = 1;
my @prose;

# Links may run over lines, so prose is changed paragraph by paragraph; code spans are kept as they are.
sub flush_prose {
    my $prose = join "\n", @prose;
    @prose = ();
    my @code;
    $prose =~ s/(`[^`\n]*`)/push @code, $1; "\x01" . $#code . "\x02"/ge;
    $prose =~ s/<a id="([^"]+)"><\/a>/\@anchor $page-$1 /g;
    $prose =~ s/(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)/link_to($1, $2)/ge;
    $prose =~ s/\x01(\d+)\x02/$code[$1]/g;
    push @out, $prose;
}

for my $line (split /\n/, $text, -1) {
    if ($line =~ /^\s*```/) {
        flush_prose() if @prose;
        $in_fence = !$in_fence;
        # Doxygen knows no language of that name: no highlighting.
        $line =~ s/```(toml|sh|cmake|json)\s*$/```/;
        push @out, $line;
    } elsif ($in_fence) {
        push @out, $line;
    } elsif ($line =~ /^(#{1,6}) +(.*?) *#*$/) {
        flush_prose() if @prose;
        my ($level, $heading) = ($1, $2);
        my $name = slug($heading);
        my $before = $met{$name}++;
        $name .= "-$before" if $before;
        my $label = $is_first_heading ? ($page eq 'index' ? 'mainpage' : $page) : "$page-$name";
        # In a heading neither code nor links are wanted.
        $heading =~ s/\[([^\]]*)\]\([^)]*\)/$1/g;
        $heading =~ s/`//g;
        push @out, "$level $heading {#$label}";
        $is_first_heading = 0;
    } else {
        push @prose, $line;
    }
}
flush_prose() if @prose;
print join("\n", @out);
