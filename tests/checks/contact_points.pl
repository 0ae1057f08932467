#!/usr/bin/perl
# contact_points.pl FILE.vtu...: the points of contact pictures, which deal.II writes
# as compressed binary, as lines "x y z pair status gap pressure nx ny nz tx ty tz
# sx sy sz", each slave node once; t is the traction, s the slip.
use strict;
use warnings;
use Compress::Zlib;
use MIME::Base64;

# Blocks of VTK's inline format: number of blocks, size of a block and of the last
# one, size of each when compressed, as 32-bit integers in base64; then the blocks.
sub unpack_array {
  my ($text) = @_;
  $text =~ s/\s//g;
  my $blocks = unpack('V', decode_base64(substr($text, 0, 8)));
  my $length = 4 * int((4 * (3 + $blocks) + 2) / 3);
  my (undef, undef, undef, @sizes) = unpack('V*', decode_base64(substr($text, 0, $length)));
  my $data = decode_base64(substr($text, $length));
  my ($result, $start) = ('', 0);
  for my $size (@sizes[0 .. $blocks - 1]) {
    $result .= uncompress(substr($data, $start, $size));
    $start += $size;
  }
  return $result;
}

my %seen;
for my $file (@ARGV) {
  open(my $in, '<', $file) or die "$file: $!\n";
  my $text = do { local $/; <$in> };
  close($in);
  while ($text =~ m{<Piece (.*?)</Piece>}gs) {
    my $piece = $1;
    my %array;
    while ($piece =~ m{<DataArray type="Float(32|64)"([^>]*)>\s*(.*?)\s*</DataArray>}gs) {
      my ($bits, $attributes, $data) = ($1, $2, $3);
      my $name = $attributes =~ /Name="([^"]*)"/ ? $1 : 'position';
      $array{$name} = [unpack($bits == 32 ? 'f*' : 'd*', unpack_array($data))];
    }
    next unless $array{position};
    for my $i (0 .. @{$array{position}} / 3 - 1) {
      my @line = map { $_ + 0 } @{$array{position}}[3 * $i .. 3 * $i + 2];
      push @line, $array{$_}[$i] for qw(pair status gap pressure);
      push @line, @{$array{$_}}[3 * $i .. 3 * $i + 2] for qw(normal traction slip);
      my $line = join(' ', map { sprintf('%.8g', $_) } @line);
      my $key  = join(' ', map { sprintf('%.6g', $_) } @line[0 .. 3]);
      print "$line\n" unless $seen{$key}++;
    }
  }
}
